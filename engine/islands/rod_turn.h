#pragma once

#include <cmath>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// rad/s at which a rod turns, or a rope or spring as long as it is: a ball at its end goes round without turning
/// itself, so that its spin does not tell how far its way is from straight. 0 of other joints.
inline double rodTurnOf(const WorldState& world, const Joint& joint) {
    if (joint.type() != JointType::distance) { return 0; }
    const BodyMotion& a = world.motions[joint.bodyA];
    const BodyMotion& b = world.motions[joint.bodyB];
    const auto velocityAt = [](const BodyMotion& motion, DVec2 point) {
        const DVec2 arm = point - motion.center;
        return toDouble(motion.velocity) + static_cast<double>(motion.angularVelocity) * DVec2{-arm.y, arm.x};
    };
    const DVec2 endA = apply(a.pose, joint.localAnchorA);
    const DVec2 endB = apply(b.pose, joint.localAnchorB);
    const DVec2 rod = endB - endA;
    const double square = dot(rod, rod);
    if (!(square > 0)) { return 0; }
    return std::fabs(cross(rod, velocityAt(b, endB) - velocityAt(a, endA))) / square;
}

}  // namespace swept::inline SWEPT_PRECISION
