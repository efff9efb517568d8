#pragma once

#include <cstdint>

#include "../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// The implementations. They give the same answers; README.md of this folder shows what each costs where.
enum class BroadphaseKind : std::uint8_t {
    automatic,     ///< what the measurements favour
    allPairs,      ///< every box against every box that moved
    sortAndSweep,  ///< boxes sorted along the axis on which they spread most
    quadtree,      ///< loose quadtree: a square of the world per box, by size and place
    grid,          ///< cells of one size
    bvh,           ///< binary tree of boxes, updated box by box
    wideBvh        ///< tree of eight boxes per node, refitted and rebuilt as a whole
};
inline constexpr int kBroadphaseKindCount = 7;

}  // namespace swept::inline SWEPT_PRECISION
