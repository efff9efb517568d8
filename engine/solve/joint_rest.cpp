#include "joint_rest.h"

#include "../bodies/body_joints.h"

#include <cmath>
#include <variant>
#include <vector>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// In so many of the times √(extent/|gravity|) in which things fall about their own size the load of what moves goes
/// down to 1/e.
constexpr double kLooseningFalls = 2;
/// Weights of the lighter body: a load of less is none.
constexpr Real kLeastRestLoad = Real(1) / 1024;
/// Of its weight: what joints leave of a body at rest.
constexpr Real kMostUnbalanced = Real(1) / 16;
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

/// A small one is none.
void giveRestLoad(WorldState& world, std::uint32_t slot, const JointLoad& load) {
    Joint& joint = world.joints[slot];
    joint.restLoad = load;
    if (isSmall(world, joint)) { joint.restLoad = {}; }
    world.jointTies[slot].hasRestLoad = joint.restLoad.any();
    world.anyRestLoads = world.anyRestLoads || joint.restLoad.any();
}

/// Of the last step; nothing of what gives way.
JointLoad reactionOf(const WorldState& world, const Joint& joint) {
    switch (joint.type()) {
        case JointType::revolute:
            return {joint.reactionForce, 0};
        case JointType::weld: {
            const WeldJointDef& def = std::get_if<JointPart<WeldJointDef, WeldConstraint>>(&joint.parts)->def;
            if (def.linearSpring || def.angularSpring) { return {}; }
            return {joint.reactionForce, joint.reactionTorque};
        }
        case JointType::distance: {
            const DistanceJointDef& def =
                std::get_if<JointPart<DistanceJointDef, DistanceConstraint>>(&joint.parts)->def;
            if (def.spring || def.limits) { return {}; }
            const DVec2 rod = apply(world.motions[joint.bodyB].pose, joint.localAnchorB) -
                              apply(world.motions[joint.bodyA].pose, joint.localAnchorA);
            return {{dot(normalized(toReal(rod)).unit, joint.reactionForce), 0}, 0};
        }
        default:
            return {};
    }
}

bool isAmong(std::span<const std::uint32_t> sorted, std::uint32_t slot) {
    return std::binary_search(sorted.begin(), sorted.end(), slot);
}

/// Lowest body of what the joint is part of.
std::uint32_t chainOf(WorldState& world, const Joint& joint) {
    return world.jointChains.finder.find(heldBodyOf(world, joint));
}

/// Forces of joints in the last step and weights, by member of all chains: blows are no loads at rest.
std::vector<Vec2> forcesOnMembers(WorldState& world, std::span<const std::uint32_t> chains) {
    const std::vector<JointChains::Member>& members = world.jointChains.members;
    std::vector<Vec2> forces(members.size());
    const auto add = [&](std::uint32_t body, Vec2 force) {
        const auto isLower = [](const JointChains::Member& a, std::uint32_t slot) { return a.body < slot; };
        const auto place = std::lower_bound(members.begin(), members.end(), body, isLower);
        if (place != members.end() && place->body == body) {
            forces[static_cast<std::size_t>(place - members.begin())] += force;
        }
    };
    for (std::size_t i = 0; i < members.size(); ++i) {
        const Body& body = world.bodies[members[i].body];
        forces[i] = static_cast<Real>(body.mass) * body.def.gravityScale * world.settings.gravity;
    }
    for (const std::uint32_t slot : world.activeJoints) {
        const Joint& joint = world.joints[slot];
        if (!isAmong(chains, chainOf(world, joint))) { continue; }
        add(joint.bodyA, -joint.reactionForce);
        add(joint.bodyB, joint.reactionForce);
    }
    return forces;
}

/// Those of the chains that hung still in the last step.
std::vector<std::uint32_t> balancedOf(WorldState& world, std::span<const std::uint32_t> chains) {
    const std::vector<Vec2> forces = forcesOnMembers(world, chains);
    const Real gravity = length(world.settings.gravity);
    std::vector<std::uint32_t> moving;  // some of them more than once
    for (std::size_t i = 0; i < forces.size(); ++i) {
        const auto [body, lowest] = world.jointChains.members[i];
        const Real most = kMostUnbalanced * static_cast<Real>(world.bodies[body].mass) * gravity;
        if (length(forces[i]) > most || isOnTheMove(world, body)) { moving.push_back(lowest); }
    }
    std::sort(moving.begin(), moving.end());
    std::vector<std::uint32_t> balanced(chains.begin(), chains.end());
    std::erase_if(balanced, [&moving](std::uint32_t lowest) { return isAmong(moving, lowest); });
    return balanced;
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
            const Joint& joint = world.joints[constraint.source];
            const JointLoad more = moreThan(joint, constraint, 1 / h);
            giveRestLoad(world, constraint.source,
                         {joint.restLoad.force + more.force, joint.restLoad.torque + more.torque});
        }
    };
    add(batch.revolutes);
    add(batch.welds);
    add(batch.distances);
}

void bearReactions(WorldState& world, std::span<const std::uint32_t> chains) {
    if (chains.empty()) { return; }
    const std::vector<std::uint32_t> balanced = balancedOf(world, chains);
    for (const std::uint32_t slot : world.activeJoints) {
        const Joint& joint = world.joints[slot];
        if (isAmong(balanced, chainOf(world, joint))) { giveRestLoad(world, slot, reactionOf(world, joint)); }
    }
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
