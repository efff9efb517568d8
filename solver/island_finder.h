#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace swept {

/// Connected components by union–find with path halving; the root of a component is its lowest member, so the result
/// does not depend on the order of the unions.
class IslandFinder {
public:
    /// `count` members, each on its own.
    void reset(std::size_t count) {
        parents_.resize(count);
        for (std::size_t i = 0; i < count; ++i) { parents_[i] = static_cast<std::uint32_t>(i); }
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

private:
    /// The same as `find`. Mostly the root is no farther than two steps.
    std::uint32_t findNear(std::uint32_t member) {
        const std::uint32_t root = parents_[parents_[member]];
        return parents_[root] == root ? root : find(root);
    }

    std::vector<std::uint32_t> parents_;
};

}  // namespace swept
