#include "body_joints.h"

#include <algorithm>
#include <optional>

#include "awake.h"
#include "levers.h"
#include "world_boxes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A gear that the joint is part of.
std::optional<JointId> gearOn(const WorldState& world, JointId id) {
    const Joint& joint = world.joints[id.index];
    for (const std::uint32_t slot : fewerJoints(world, joint.bodyA, joint.bodyB)) {
        const auto* part = std::get_if<JointPart<GearJointDef, GearConstraint>>(&world.joints[slot].parts);
        if (part != nullptr && (part->def.jointA == id || part->def.jointB == id)) { return world.joints.idOf(slot); }
    }
    return std::nullopt;
}

}  // namespace

std::span<const std::uint32_t> fewerJoints(const WorldState& world, std::uint32_t bodyA, std::uint32_t bodyB) {
    const std::vector<std::uint32_t>& ofA = world.bodies[bodyA].joints;
    const std::vector<std::uint32_t>& ofB = world.bodies[bodyB].joints;
    return ofA.size() <= ofB.size() ? ofA : ofB;
}

bool canHold(const WorldState& world, const Joint& joint) {
    const std::span<const std::uint32_t> bodies = joint.allBodies();
    const auto isEnabled = [&world](std::uint32_t body) { return world.bodies[body].def.enabled; };
    if (!std::all_of(bodies.begin(), bodies.end(), isEnabled)) { return false; }
    const bool movesA = world.bodies[joint.bodyA].isDynamic() && joint.type() != JointType::mouse;
    return movesA || world.bodies[joint.bodyB].isDynamic();
}

std::uint32_t bodyOfFewerShapes(const WorldState& world, const Joint& joint) {
    const Body& a = world.bodies[joint.bodyA];
    const Body& b = world.bodies[joint.bodyB];
    // As many: not the one that many others may lie on.
    if (a.shapes.size() == b.shapes.size()) { return a.isDynamic() ? joint.bodyA : joint.bodyB; }
    return a.shapes.size() < b.shapes.size() ? joint.bodyA : joint.bodyB;
}

void removeJoint(WorldState& world, JointId id, std::uint32_t leaving) {
    while (const std::optional<JointId> gear = gearOn(world, id)) { removeJoint(world, *gear, leaving); }
    const Joint& joint = world.joints[id.index];
    world.jointTies[id.index] = {};
    world.jointChains.areCurrent = false;
    for (const std::uint32_t slot : joint.allBodies()) {
        Body& body = world.bodies[slot];
        std::erase(body.joints, id.index);
        body.holdingJoints -= joint.holds() ? 1 : 0;
        if (isAtLever(body)) { resistTurns(world, slot); }
        rouse(world, slot);
    }
    const bool mayMeet = joint.bodyA != leaving && joint.bodyB != leaving;
    // So that the pairs it kept apart are found, each of which has a shape of either.
    if (joint.keepsApart() && mayMeet) { renewProxies(world, bodyOfFewerShapes(world, joint)); }
    world.joints.erase(id);
}

}  // namespace swept::inline SWEPT_PRECISION
