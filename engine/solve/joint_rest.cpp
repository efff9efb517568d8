#include "joint_rest.h"

#include <cmath>
#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// In so many of the times √(extent/|gravity|) in which things fall about their own size the load of what moves goes
/// down to 1/e.
constexpr double kLooseningFalls = 2;
/// Weights of the lighter body: a load of less is none.
constexpr Real kLeastRestLoad = Real(1) / 1024;
/// On the move is what is as fast as in a fall of half of this part of its extent (as in island_load.cpp).
constexpr Real kMoveRatioOfFall = Real(1) / 16;

JointLoad moreThan(const Joint& before, const RevoluteConstraint& now, Real rate) {
    return {rate * (now.linearImpulse - before.hinge.point), 0};
}
JointLoad moreThan(const Joint& before, const WeldConstraint& now, Real rate) {
    if (now.hasLinearSpring || now.hasAngularSpring) { return {}; }
    const WeldConstraint& memory = std::get_if<JointPart<WeldJointDef, WeldConstraint>>(&before.parts)->memory;
    return {rate * (now.linearImpulse - memory.linearImpulse), rate * (now.angularImpulse - memory.angularImpulse)};
}
JointLoad moreThan(const Joint& before, const DistanceConstraint& now, Real rate) {
    if (!now.isRigid) { return {}; }
    const auto& memory = std::get_if<JointPart<DistanceJointDef, DistanceConstraint>>(&before.parts)->memory;
    return {{rate * (now.rigidImpulse - memory.rigidImpulse), 0}, 0};
}

/// kg
Real lighterOf(const WorldState& world, const Joint& joint) {
    const Real most = std::max(world.bodies[joint.bodyA].inverseMass, world.bodies[joint.bodyB].inverseMass);
    return most > 0 ? 1 / most : Real(0);
}

bool isSmall(const WorldState& world, const Joint& joint) {
    const Real extent = std::max(world.bodies[joint.bodyA].radius, world.bodies[joint.bodyB].radius);
    const Real least = kLeastRestLoad * lighterOf(world, joint) * length(world.settings.gravity);
    return length(joint.restLoad.force) <= least && std::fabs(joint.restLoad.torque) <= least * extent;
}

/// Part of its load that a joint has left after a step in which its bodies moved.
Real leftOf(const WorldState& world, const JointTie& tie, double dt) {
    Real extent = 0;
    for (const std::uint32_t slot : {tie.bodyA, tie.bodyB}) {
        const Body& body = world.bodies[slot];
        if (body.isDynamic() && (extent == 0 || body.extent < extent)) { extent = body.extent; }
    }
    const auto gravity = static_cast<double>(length(world.settings.gravity));
    if (!(gravity > 0) || !(extent > 0)) { return 0; }
    const double time = kLooseningFalls * std::sqrt(static_cast<double>(extent) / gravity);
    return static_cast<Real>(std::max(1 - dt / time, 0.0));
}

}  // namespace

bool isOnTheMove(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const Real swing = body.radius * motion.angularVelocity;
    return body.isDynamic() && lengthSquared(motion.velocity) + square(swing) >
                                   kMoveRatioOfFall * length(world.settings.gravity) * body.extent;
}

void addRestLoads(WorldState& world, SolverBatch& batch, Real h) {
    const auto add = [&world, h](const auto& constraints) {
        for (const auto& constraint : constraints) {
            Joint& joint = world.joints[constraint.source];
            const JointLoad more = moreThan(joint, constraint, 1 / h);
            joint.restLoad.force += more.force;
            joint.restLoad.torque += more.torque;
            if (isSmall(world, joint)) { joint.restLoad = {}; }
            world.jointTies[constraint.source].hasRestLoad = joint.restLoad.any();
            world.anyRestLoads = world.anyRestLoads || joint.restLoad.any();
        }
    };
    add(batch.revolutes);
    add(batch.welds);
    add(batch.distances);
}

void loosenMoving(WorldState& world, double dt) {
    bool any = false;
    for (const std::uint32_t slot : world.activeJoints) {
        JointTie& tie = world.jointTies[slot];
        if (!tie.hasRestLoad) { continue; }
        any = true;
        if (!isOnTheMove(world, tie.bodyA) && !isOnTheMove(world, tie.bodyB)) { continue; }
        Joint& joint = world.joints[slot];
        const Real left = leftOf(world, tie, dt);
        joint.restLoad.force = left * joint.restLoad.force;
        joint.restLoad.torque *= left;
        if (!isSmall(world, joint)) { continue; }
        joint.restLoad = {};
        tie.hasRestLoad = false;
    }
    world.anyRestLoads = any || world.activeJoints.size() < world.joints.size();
}

}  // namespace swept::inline SWEPT_PRECISION
