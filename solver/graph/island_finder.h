#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/listed_members.h"

namespace swept {

/// Connected components by union–find with path halving; the root of a component is its lowest member, so the result
/// does not depend on the order of the unions.
class IslandFinder {
public:
    /// `count` members, each on its own.
    void reset(std::size_t count) {
        standAloneFrom(0, count);
        united_.clear();
        mayAllBeUnited_ = true;
    }

    /// The same where most stay on their own from one time to the next, as what sleeps does: where those that are
    /// united are few, the others are not touched.
    /// @param united  the only ones that are, until the next time
    void reset(std::size_t count, std::span<const std::uint32_t> united) {
        const bool areMany = kFewShare * united.size() >= count;
        if (areMany || mayAllBeUnited_) {
            reset(count);
        } else {
            for (const std::uint32_t member : united_) { parents_[member] = member; }
            standAloneFrom(parents_.size(), count);
        }
        mayAllBeUnited_ = areMany;
        if (!areMany) { united_.assign(united.begin(), united.end()); }
    }

    /// Unites whom `other` has united. @pre just reset, with the same count and members as that one
    void uniteAs(const IslandFinder& other) {
        if (mayAllBeUnited_) { parents_ = other.parents_; }
        for (const std::uint32_t member : united_) { parents_[member] = other.parents_[member]; }
    }

    std::uint32_t find(std::uint32_t member) {
        while (parents_[member] != member) {
            parents_[member] = parents_[parents_[member]];
            member = parents_[member];
        }
        return member;
    }

    /// The same without halving any path: several threads may ask at the same time.
    std::uint32_t rootOf(std::uint32_t member) const {
        while (parents_[member] != member) { member = parents_[member]; }
        return member;
    }

    /// Hangs members below their roots, as found: the next to ask finds them at once.
    void flatten(std::span<const std::uint32_t> members, std::span<const std::uint32_t> roots) {
        for (std::size_t i = 0; i < members.size(); ++i) { parents_[members[i]] = roots[i]; }
    }

    /// Without a branch: whether two that touch were united already, and which root is lower, nothing foretells. What
    /// was asked for hangs below the root at once.
    void unite(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t rootA = findNear(a);
        const std::uint32_t rootB = findNear(b);
        const std::uint32_t low = std::min(rootA, rootB);
        parents_[std::max(rootA, rootB)] = low;
        parents_[a] = low;
        parents_[b] = low;
    }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.parents_, self.united_, self.mayAllBeUnited_);
    }

private:
    /// Of more than one in so many it is faster to go through all of them in order.
    static constexpr std::size_t kFewShare = 8;

    void standAloneFrom(std::size_t first, std::size_t count) {
        parents_.resize(count);
        for (std::size_t i = first; i < count; ++i) { parents_[i] = static_cast<std::uint32_t>(i); }
    }
    /// The same as `find`. Mostly the root is no farther than two steps.
    std::uint32_t findNear(std::uint32_t member) {
        const std::uint32_t root = parents_[parents_[member]];
        return parents_[root] == root ? root : find(root);
    }

    std::vector<std::uint32_t> parents_;
    std::vector<std::uint32_t> united_;  ///< who may be, unless all may
    bool mayAllBeUnited_ = false;
};

}  // namespace swept
