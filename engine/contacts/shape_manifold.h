#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Manifold of two shapes of the world, A's frame. Where A is ground (static or kinematic) and the normal lies within
/// `kFaceSine` (ghosts.h) of one of its faces, that face gives the normal: a body that hangs over the end of a piece of
/// a flat floor would otherwise be led along its own side, and steer itself off the floor by as much as it is tilted.
/// @param margin  largest separation at which a point is still reported, metres
/// @param reach   the same, and how far away the deepest point may be: of chain segments, whatever it is
/// @param memory  of these two shapes, from query to query
Manifold shapeManifold(const WorldState& world, const Shape& a, const Shape& b, const Transform& bInA,
                       ManifoldReach reach, ManifoldMemory& memory);
Manifold shapeManifold(const WorldState& world, const Shape& a, const Shape& b, const Transform& bInA, Real margin);
/// Whether that may be another normal than the one that was found. @pre A is ground, and no chain segment
bool mayTurnToGround(const Polygon& a, Vec2 normal);
/// The second half of that: from the manifold of the closest features (`collide`). @pre no chain segments
Manifold turnedToGround(const WorldState& world, const Shape& a, const Shape& b, const Transform& bInA, Real margin,
                        const Manifold& closest);

}  // namespace swept::inline SWEPT_PRECISION
