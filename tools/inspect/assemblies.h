#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace swept {

/// Bodies that hang together, as sets; the root of a set is its lowest body.
class Assemblies {
public:
    explicit Assemblies(std::size_t bodies) : parent_(bodies) { std::iota(parent_.begin(), parent_.end(), 0); }

    int rootOf(int i) const {
        while (parent_[static_cast<std::size_t>(i)] != i) { i = parent_[static_cast<std::size_t>(i)]; }
        return i;
    }
    void join(int a, int b) {
        const int rootA = rootOf(a);
        const int rootB = rootOf(b);
        parent_[static_cast<std::size_t>(std::max(rootA, rootB))] = std::min(rootA, rootB);
    }

private:
    std::vector<int> parent_;
};

}  // namespace swept
