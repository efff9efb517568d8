#pragma once

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

    void unite(std::uint32_t a, std::uint32_t b) {
        const std::uint32_t rootA = find(a);
        const std::uint32_t rootB = find(b);
        if (rootA == rootB) { return; }  // as mostly, in a heap: nothing is written
        // What was asked for hangs below the new root at once.
        if (rootA < rootB) {
            parents_[rootB] = parents_[b] = rootA;
        } else {
            parents_[rootA] = parents_[a] = rootB;
        }
    }

private:
    std::vector<std::uint32_t> parents_;
};

}  // namespace swept
