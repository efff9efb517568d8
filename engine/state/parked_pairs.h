#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/listed_members.h"
#include "contact.h"
#include "no_index.h"

namespace swept::inline SWEPT_PRECISION {

/// Pairs of which neither body is awake. Each stays in its place until it goes; the two shapes have it in a list of
/// theirs, by proxy, so to find those of a shape costs what it has, and not what sleeps, nor what else its body has: a
/// level of thousands of tiles may be one. Kept for its capacity.
/// @tparam Pair  a `ContactPair`, maybe with more
template <class Pair>
class ParkedPairs {
public:
    void reserve(std::size_t count) {
        pairs_.reserve(count);
        links_.reserve(2 * count);
    }

    /// @return its place
    std::uint32_t add(const Pair& pair) {
        const std::uint32_t place = takePlace();
        pairs_[place] = pair;
        link(2 * place, pair.proxyA);
        link(2 * place + 1, pair.proxyB);
        return place;
    }

    void erase(std::uint32_t place) {
        unlink(2 * place, pairs_[place].proxyA);
        unlink(2 * place + 1, pairs_[place].proxyB);
        makeGap(pairs_[place]);
        links_[2 * place].next = firstFree_;
        firstFree_ = place;
        ++freeCount_;
    }

    Pair& operator[](std::uint32_t place) { return pairs_[place]; }
    std::size_t size() const { return pairs_.size() - freeCount_; }
    std::size_t capacity() const { return pairs_.capacity(); }
    /// By place: those that are free are gaps (`isGap`).
    std::span<Pair> all() { return pairs_; }
    std::span<const Pair> all() const { return pairs_; }

    /// Calls `visit` with the place of each pair of a proxy, the last one first.
    template <class Visit>
    void visitOf(ProxyId proxy, Visit&& visit) const {
        const auto list = static_cast<std::size_t>(proxy);
        if (list >= first_.size()) { return; }
        for (std::uint32_t end = first_[list]; end != kNoIndex; end = links_[end].next) { visit(end / 2); }
    }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.pairs_, self.links_, self.first_, self.firstFree_, self.freeCount_);
    }

private:
    /// Of one end of a pair, in the list of the proxy at that end. An end is twice the place, and one more for B. Of a
    /// free place `next` of A is the next free place.
    struct Link {
        std::uint32_t before = kNoIndex;
        std::uint32_t next = kNoIndex;
    };

    std::uint32_t takePlace() {
        if (firstFree_ == kNoIndex) {
            pairs_.emplace_back();
            links_.resize(2 * pairs_.size());
            return static_cast<std::uint32_t>(pairs_.size() - 1);
        }
        const std::uint32_t place = firstFree_;
        firstFree_ = links_[2 * place].next;
        --freeCount_;
        return place;
    }

    void link(std::uint32_t end, ProxyId proxy) {
        const auto list = static_cast<std::size_t>(proxy);
        if (list >= first_.size()) { first_.resize(list + 1, kNoIndex); }
        const std::uint32_t next = first_[list];
        links_[end] = {kNoIndex, next};
        if (next != kNoIndex) { links_[next].before = end; }
        first_[list] = end;
    }

    void unlink(std::uint32_t end, ProxyId proxy) {
        const Link link = links_[end];
        (link.before != kNoIndex ? links_[link.before].next : first_[static_cast<std::size_t>(proxy)]) = link.next;
        if (link.next != kNoIndex) { links_[link.next].before = link.before; }
    }

    std::vector<Pair> pairs_;
    std::vector<Link> links_;           ///< by end
    std::vector<std::uint32_t> first_;  ///< by proxy: end, or none
    std::uint32_t firstFree_ = kNoIndex;
    std::size_t freeCount_ = 0;
};

}  // namespace swept::inline SWEPT_PRECISION
