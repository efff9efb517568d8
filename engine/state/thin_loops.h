#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"
#include "../../solver/direct/block_ldlt.h"

namespace swept::inline SWEPT_PRECISION {

/// Scratch; empty where there are no large loops.
struct ThinLoops {
    struct Tie {
        std::uint32_t chain = 0;  ///< in `JointChains::list`
        BlockEdge bodies;         ///< as they are counted in the chain
    };
    std::vector<std::uint32_t> numbers;  ///< by slot
    std::vector<std::uint32_t> counts;   ///< by chain: of its bodies that have their number
    std::vector<Tie> ties;
    std::vector<BlockEdge> edges;
    BlockLdlt factor;
};

}  // namespace swept::inline SWEPT_PRECISION
