#pragma once

#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Loops of so many bodies are solved all at once however they hang together; up to so many where that costs little for
/// each of them.
inline constexpr std::uint32_t kMostLoopBodies = 64;
inline constexpr std::uint32_t kMostThinBodies = 256;

/// Finds `JointChain::isThin` of loops of more than `kMostLoopBodies`. @pre all else of the chains is found
void findThinLoops(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
