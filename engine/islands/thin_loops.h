#pragma once

#include <cstdint>
#include <vector>

#include "../../solver/direct/block_ldlt.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Loops of so many bodies are solved all at once however they hang together; up to so many where that costs little for
/// each of them.
inline constexpr std::uint32_t kMostLoopBodies = 64;
inline constexpr std::uint32_t kMostThinBodies = 256;

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

/// Finds `JointChain::isThin` of loops of more than `kMostLoopBodies`. @pre all else of the chains is found
void findThinLoops(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
