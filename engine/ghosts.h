#pragma once

#include "world_state.h"

/// Ghost collisions: a body that slides from one flush piece of ground to the next meets the side or the corner of the next
/// piece, which the ground before it hides. What tells them apart from a wall: along the normal of the ground it stands on,
/// the body is already clear of the next piece. So a contact yields to another one of the same body whose normal keeps the
/// two shapes apart just as well, to within the slop.

namespace swept::inline SWEPT_PRECISION {

/// Normals closer than this (cosine) are one: neither contact can hide the other.
inline constexpr Real kSameNormal = 1 - Real(1) / 1024;

/// Separation of two placed shapes along a world direction from A to B, radii included, metres: how far B's lowest point
/// lies above A's highest.
Real separationAlong(const Polygon& a, const WorldTransform& poseA, const Polygon& b, const WorldTransform& poseB,
                     Vec2 direction);

/// Drops the ghosts among the contacts of awake dynamic bodies with static and kinematic shapes.
void dropGhosts(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
