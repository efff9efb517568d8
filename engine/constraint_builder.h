#pragma once

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Constraint of a contact's manifold, taken at the given poses (world); slots are left to the caller. Impulses are zero.
/// @param maxPushSpeed  m/s
ContactConstraint constraintOf(const Manifold& manifold, const BodyMotion& a, Vec2 localCenterA, const BodyMotion& b,
                               Real friction, Real restitution, Real maxPushSpeed);

/// Constraints of the joints, with slots, anchors and warm-start impulses; `h` is the length of a sub-step.
RevoluteConstraint revoluteOf(const WorldState& world, const Joint& joint, std::uint32_t source, Real h);
DistanceConstraint distanceOf(const WorldState& world, const Joint& joint, std::uint32_t source, Real h);

/// Gap of the anchors, or violation of rod or limits, at the present poses. Metres.
Real errorOf(const WorldState& world, const Joint& joint);

}  // namespace swept::inline SWEPT_PRECISION
