#pragma once

#include <span>

#include "../shapes/chain.h"
#include "shape_def.h"

namespace swept::inline SWEPT_PRECISION {

/// A chain with all that it may have (`World::addChain`). What it refers to is read in the call, and not kept.
struct ChainDef {
    std::span<const Vec2> points{};  ///< in the frame of the body, metres
    bool loop = false;               ///< the last point goes on to the first one
    ShapeDef shape{};                ///< filter, user data, and the surface of all segments
    Real radius = 0;                 ///< metres
    ChainNeighbours neighbours{};
    /// One for each segment, in the order of the points, instead of that of `shape`; or none. An open chain has as many
    /// segments as points less one, a loop as many as points.
    std::span<const Surface> surfaces{};
};

}  // namespace swept::inline SWEPT_PRECISION
