#include "constraint_builder.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kTwoPi = 6.283185307179586;

Vec2 armOf(const WorldState& world, std::uint32_t body, Vec2 localAnchor) {
    return rotate(world.motions[body].pose.rotation, localAnchor - world.bodies[body].localCenter);
}

Vec2 centerOffset(const WorldState& world, const Joint& joint) {
    return toReal(world.motions[joint.bodyB].center - world.motions[joint.bodyA].center);
}

Softness springOf(const Spring& spring, Real h) {
    return softnessOf(static_cast<Real>(kTwoPi) * spring.hertz, spring.dampingRatio, h);
}

/// What all kinds of joints have in common.
template <class Constraint>
void fillCommon(Constraint& constraint, const WorldState& world, const Joint& joint, std::uint32_t source, Real h) {
    constraint.slotA = world.bodies[joint.bodyA].slot;
    constraint.slotB = world.bodies[joint.bodyB].slot;
    constraint.anchorA = armOf(world, joint.bodyA, joint.localAnchorA);
    constraint.anchorB = armOf(world, joint.bodyB, joint.localAnchorB);
    constraint.centerOffset = centerOffset(world, joint);
    constraint.softness = softnessOfSubStep(kJointCycles, kJointDampingRatio, h);
    constraint.source = source;
}

}  // namespace

ContactConstraint constraintOf(const Manifold& manifold, const BodyMotion& a, Vec2 localCenterA, const BodyMotion& b,
                               Real friction, Real restitution, Real maxPushSpeed) {
    ContactConstraint constraint;
    constraint.normal = rotate(a.pose.rotation, manifold.normal);
    constraint.friction = friction;
    constraint.restitution = restitution;
    constraint.maxPushSpeed = maxPushSpeed;
    constraint.count = manifold.count;
    const Vec2 fromAToB = toReal(b.center - a.center);
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        ContactConstraintPoint& point = constraint.points[i];
        point.anchorA = rotate(a.pose.rotation, manifold.points[i].point - localCenterA);
        point.anchorB = point.anchorA - fromAToB;
        point.baseSeparation = manifold.points[i].separation;
    }
    return constraint;
}

RevoluteConstraint revoluteOf(const WorldState& world, const Joint& joint, std::uint32_t source, Real h) {
    RevoluteConstraint constraint = joint.revoluteState;  // the impulses
    fillCommon(constraint, world, joint, source, h);
    const double angle = world.motions[joint.bodyB].angle - world.motions[joint.bodyA].angle - joint.referenceAngle;
    constraint.baseAngle = static_cast<Real>(angle);
    const RevoluteJointDef& def = joint.revolute;
    constraint.hasLimits = def.limits.has_value();
    if (def.limits) {
        constraint.lower = def.limits->lower;
        constraint.upper = def.limits->upper;
    }
    constraint.hasMotor = def.motor.has_value();
    if (def.motor) {
        constraint.motorSpeed = def.motor->speed;
        constraint.maxMotorImpulse = h * def.motor->maxTorque;
    }
    constraint.hasSpring = def.spring.has_value();
    if (def.spring) { constraint.spring = springOf(*def.spring, h); }
    return constraint;
}

DistanceConstraint distanceOf(const WorldState& world, const Joint& joint, std::uint32_t source, Real h) {
    DistanceConstraint constraint = joint.distanceState;  // the impulses
    fillCommon(constraint, world, joint, source, h);
    const DistanceJointDef& def = joint.distance;
    constraint.length = joint.length;
    constraint.hasSpring = def.spring.has_value();
    if (def.spring) { constraint.spring = springOf(*def.spring, h); }
    constraint.hasLimits = def.limits.has_value();
    if (def.limits) {
        constraint.minLength = def.limits->min;
        constraint.maxLength = def.limits->max;
    }
    constraint.isRigid = !constraint.hasSpring && !constraint.hasLimits;
    return constraint;
}

Real errorOf(const WorldState& world, const Joint& joint) {
    const BodyState still{};
    const Real anyStep = 1;  // the error does not depend on it
    switch (joint.kind) {
        case JointKind::revolute: return anchorGap(revoluteOf(world, joint, 0, anyStep), still, still);
        case JointKind::distance: return lengthError(distanceOf(world, joint, 0, anyStep), still, still);
    }
    return 0;  // unreachable, but GCC cannot know
}

}  // namespace swept::inline SWEPT_PRECISION
