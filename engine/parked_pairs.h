#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contact.h"
#include "shape.h"

namespace swept::inline SWEPT_PRECISION {

/// Pairs of which neither body is awake. Each stays in its place until it goes; the two bodies have it in a list of
/// theirs, so to find those of a body costs what it has, and not what sleeps. Kept for its capacity.
/// @tparam Pair  a `ContactPair`, maybe with more
template <class Pair>
class ParkedPairs {
public:
    void reserve(std::size_t count) {
        pairs_.reserve(count);
        links_.reserve(2 * count);
        free_.reserve(count);
    }

    void add(const Pair& pair) {
        const std::uint32_t place = takePlace();
        pairs_[place] = pair;
        link(2 * place, pair.bodyA);
        link(2 * place + 1, pair.bodyB);
    }

    void erase(std::uint32_t place) {
        unlink(2 * place, pairs_[place].bodyA);
        unlink(2 * place + 1, pairs_[place].bodyB);
        makeGap(pairs_[place]);
        free_.push_back(place);
    }

    Pair& operator[](std::uint32_t place) { return pairs_[place]; }
    std::size_t size() const { return pairs_.size() - free_.size(); }
    std::size_t capacity() const { return pairs_.capacity(); }
    /// By place: those that are free are gaps (`isGap`).
    std::span<Pair> all() { return pairs_; }
    std::span<const Pair> all() const { return pairs_; }

    /// Calls `visit` with the place of each pair of a body, the last one first.
    template <class Visit>
    void visitOf(std::uint32_t body, Visit&& visit) const {
        if (body >= first_.size()) { return; }
        for (std::uint32_t end = first_[body]; end != kNoIndex; end = links_[end].next) { visit(end / 2); }
    }

private:
    /// Of one end of a pair, in the list of the body at that end. An end is twice the place, and one more for B.
    struct Link {
        std::uint32_t before = kNoIndex;
        std::uint32_t next = kNoIndex;
    };

    std::uint32_t takePlace() {
        if (free_.empty()) {
            pairs_.emplace_back();
            links_.resize(2 * pairs_.size());
            return static_cast<std::uint32_t>(pairs_.size() - 1);
        }
        const std::uint32_t place = free_.back();
        free_.pop_back();
        return place;
    }

    void link(std::uint32_t end, std::uint32_t body) {
        if (body >= first_.size()) { first_.resize(body + std::size_t{1}, kNoIndex); }
        const std::uint32_t next = first_[body];
        links_[end] = {kNoIndex, next};
        if (next != kNoIndex) { links_[next].before = end; }
        first_[body] = end;
    }

    void unlink(std::uint32_t end, std::uint32_t body) {
        const Link link = links_[end];
        (link.before != kNoIndex ? links_[link.before].next : first_[body]) = link.next;
        if (link.next != kNoIndex) { links_[link.next].before = link.before; }
    }

    std::vector<Pair> pairs_;
    std::vector<Link> links_;           ///< by end
    std::vector<std::uint32_t> first_;  ///< by body slot: end, or none
    std::vector<std::uint32_t> free_;   ///< places
};

}  // namespace swept::inline SWEPT_PRECISION
