#include "settled.h"

#include <algorithm>
#include <cmath>

#include "../state/profile.h"
#include "../state/world_state.h"
#include "effort.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What hangs: speeds (0.2 mm/s at 60 Hz on earth), and what is left of the pulls.
constexpr Real kHangingRatio = Real(1) / (1 << 10);
constexpr std::int8_t kHangingDoublings = -3;

/// The speed of any point of a body is below the limit, and no torque turns it.
bool barelyMoves(const Body& body, const BodyMotion& motion, Real speed) {
    const Real spin = std::fabs(motion.angularVelocity) * body.radius;
    return lengthSquared(motion.velocity) <= square(speed) && spin <= speed && body.torque == 0;
}

bool isPlainHinge(const Joint& joint) {
    if (joint.type() != JointType::revolute) { return false; }
    const RevoluteJointDef& def = std::get<static_cast<std::size_t>(JointType::revolute)>(joint.parts).def;
    return !def.limits && !def.motor && !def.spring;
}

bool isDirectChain(const IslandLoad& load) {
    return load.bodies > 0 && load.contacts == 0 && load.effort.doublings >= 0 &&
           load.effort.direct != DirectScope::none && load.effort.direct != DirectScope::all;
}

/// Adds the forces of a hinge. @return whether it is one that hangs from nothing that moves
bool weighHinge(WorldState& world, const Joint& joint, Real dt) {
    const Body& a = world.bodies[joint.bodyA];
    const Body& b = world.bodies[joint.bodyB];
    if (!isPlainHinge(joint) || a.def.type == BodyType::kinematic || b.def.type == BodyType::kinematic) {
        return false;
    }
    if (a.isDynamic()) { world.islandPulls[joint.bodyA].force -= dt * joint.reactionForce; }
    if (b.isDynamic()) { world.islandPulls[joint.bodyB].force += dt * joint.reactionForce; }
    return true;
}

}  // namespace

void markSettledIslands(WorldState& world) {
    for (const std::uint32_t slot : world.tied) {
        const std::uint32_t root = world.islands.find(slot);
        const IslandRest& rest = world.islandRests[root];
        if (rest.isDirect && !rest.isRestless) {
            world.islandLoads[root].effort = {.direct = DirectScope::all, .isSettled = true};
        }
    }
}

void slowHangingIslands(WorldState& world, double dt) {
    const auto step = static_cast<Real>(dt);
    const Real speed = kHangingRatio * length(world.settings.gravity) * step;
    world.islandPulls.resize(std::max<std::size_t>(world.islandPulls.size(), world.bodies.slotCount()));
    // Their effort tells what is still in question: those that move keep theirs.
    world.islandHangs.resize(world.bodies.slotCount());
    for (const std::uint32_t slot : world.tied) {
        world.islandHangs[slot] = isDirectChain(world.islandLoads[slot]) ? 1 : 0;
    }
    for (const std::uint32_t slot : world.tied) {
        const Body& body = world.bodies[slot];
        std::uint8_t& hangs = world.islandHangs[world.islands.find(slot)];
        if (hangs == 0) { continue; }
        hangs = barelyMoves(body, world.motions[slot], speed) ? 1 : 0;
        world.islandPulls[slot].force = (static_cast<Real>(body.mass) * step) * accelerationOf(world, body);
    }
    for (const std::uint32_t i : world.activeJoints) {
        const JointTie& tie = world.jointTies[i];
        const std::uint32_t moved = isAwakeDynamic(world, tie.bodyA) ? tie.bodyA : tie.bodyB;
        std::uint8_t& hangs = world.islandHangs[world.islands.find(moved)];
        hangs = hangs != 0 && weighHinge(world, world.joints[i], step) ? 1 : 0;
    }
    for (const std::uint32_t slot : world.tied) {
        const Body& body = world.bodies[slot];
        std::uint8_t& hangs = world.islandHangs[world.islands.find(slot)];
        if (hangs == 0) { continue; }
        hangs = lengthSquared(world.islandPulls[slot].force) <= square(static_cast<Real>(body.mass) * speed) ? 1 : 0;
    }
    for (const std::uint32_t slot : world.tied) {
        if (world.islandHangs[slot] != 0) { world.islandLoads[slot].effort.doublings = kHangingDoublings; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
