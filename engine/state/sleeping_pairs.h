#pragma once

#include <cstdint>
#include <vector>

namespace swept {

/// Scratch of waking.cpp, kept for its capacity: pairs that touch, both of whose bodies slept when they were looked at.
/// Pairs are named by their places in `WorldState::touching`.
struct SleepingPairs {
    /// Such a pair of one of its bodies.
    struct Link {
        std::uint32_t pair = 0;
        std::uint32_t next = 0;  ///< in `links`: another one of the body
    };
    std::vector<Link> links;
    std::vector<std::uint32_t> firsts;  ///< by body slot: place in `links`
    std::vector<std::uint32_t> due;     ///< of what woke: a heap, the lowest first
    std::vector<std::uint32_t> dueNext;
};

}  // namespace swept
