#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Anchors and separation of a point of a manifold, taken at the pose of A (world); the rest is zero.
/// @param fromAToB  between the centres of mass
inline ContactConstraintPoint constraintPointOf(const ManifoldPoint& point, const BodyMotion& a, Vec2 localCenterA,
                                                Vec2 fromAToB) {
    const Vec2 anchorA = rotate(a.pose.rotation, point.point - localCenterA);
    return {.anchorA = anchorA, .anchorB = anchorA - fromAToB, .baseSeparation = point.separation};
}

/// Constraint of a contact's manifold, taken at the given poses (world); slots are left to the caller. Impulses are
/// zero.
/// @param maxPushSpeed  m/s
ContactConstraint constraintOf(const Manifold& manifold, const BodyMotion& a, Vec2 localCenterA, const BodyMotion& b,
                               const MixedSurface& surface, Real maxPushSpeed);

}  // namespace swept::inline SWEPT_PRECISION
