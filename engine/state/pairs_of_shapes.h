#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/copied_atomic.h"
#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// Since the last step: whether the lists of pairs by proxy are there, to their end.
enum class ListState : std::uint8_t { none, beingMade, listed };

/// Where the contacts and candidates of a shape stand, for what is destroyed or put elsewhere between steps. A place
/// counts through probes, parked probes, candidates and parked candidates. What is not parked leaves a gap when it is
/// removed, until the next step closes all of them at once: so each of many removals costs what the shape has, and not
/// what the world has.
struct PairsOfShapes {
    CopiedAtomic<int> scans = 0;  ///< since the last step: pairs that were found by a look at all not parked
    CopiedAtomic<ListState> state = ListState::none;
    std::size_t gaps = 0;               ///< that are still there
    std::vector<std::uint32_t> begins;  ///< by proxy, and of one more: where its places begin
    std::vector<std::uint32_t> places;
    std::vector<std::uint32_t> found;  ///< the answer of `pairsOf`, for one thread

    PairsOfShapes() = default;
    /// A copy makes lists of its own: it may be taken while somebody asks, and makes them.
    PairsOfShapes(const PairsOfShapes& other) : gaps(other.gaps) {}
    PairsOfShapes& operator=(const PairsOfShapes& other) {
        scans = 0;
        state = ListState::none;
        gaps = other.gaps;
        return *this;
    }
    ~PairsOfShapes() = default;
};

}  // namespace swept::inline SWEPT_PRECISION
