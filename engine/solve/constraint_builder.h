#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Where a manifold, which is in the frame of A, is in the world, seen from both centres of mass.
struct ContactFrame {
    Rotation rotation{};  ///< of A
    Vec2 localCenterA{};
    Vec2 fromAToB{};  ///< from centre to centre
};

inline ContactFrame contactFrameOf(const BodyMotion& a, Vec2 localCenterA, const BodyMotion& b) {
    return {a.pose.rotation, localCenterA, toReal(b.center - a.center)};
}

/// Anchors and separation of a point of a manifold; the rest is zero.
inline ContactConstraintPoint constraintPointOf(const ManifoldPoint& point, const ContactFrame& frame) {
    const Vec2 anchorA = rotate(frame.rotation, point.point - frame.localCenterA);
    return {.anchorA = anchorA, .anchorB = anchorA - frame.fromAToB, .baseSeparation = point.separation};
}

/// Constraint of a contact's manifold; slots are left to the caller. Impulses are zero.
/// @param maxPushSpeed  m/s
ContactConstraint constraintOf(const Manifold& manifold, const ContactFrame& frame, const MixedSurface& surface,
                               Real maxPushSpeed);

}  // namespace swept::inline SWEPT_PRECISION
