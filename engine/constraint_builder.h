#pragma once

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Constraint of a contact's manifold, taken at the given poses (world); slots are left to the caller. Impulses are zero.
/// @param maxPushSpeed  m/s
ContactConstraint constraintOf(const Manifold& manifold, const BodyMotion& a, Vec2 localCenterA, const BodyMotion& b,
                               Real friction, Real restitution, Real maxPushSpeed);

}  // namespace swept::inline SWEPT_PRECISION
