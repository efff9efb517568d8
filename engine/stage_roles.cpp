#include <algorithm>

#include "modes.h"
#include "step.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void resetBody(WorldState& world, std::uint32_t slot, Real dt) {
    Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    body.touchesDynamic = body.hasContact = body.deepContact = false;
    body.fast = body.extent > 0 && motionBound(world, slot, dt) > kFastRatio * body.extent;
    body.startCenter = motion.center;
    body.startAngle = motion.angle;
}

/// What the contacts tell about one of their bodies.
void noteContact(Body& body, const Body& other, const Contact& contact) {
    if (!body.awake) { return; }
    body.hasContact = true;
    if (other.isDynamic()) {
        body.touchesDynamic = true;
        return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        body.deepContact =
            body.deepContact || contact.manifold.points[i].separation < -kShallowRatio * contact.extent;
    }
}

BodyRole roleOf(const WorldState& world, const Body& body) {
    if (!body.isDynamic()) { return BodyRole::free; }
    const ContinuousMode mode = modeOf(world, body);
    const bool alone = body.holdingJoints == 0 && !body.touchesDynamic;
    if (alone && body.fast && !body.deepContact && mode == ContinuousMode::subStep) { return BodyRole::flyer; }
    return body.holdingJoints == 0 && !body.hasContact ? BodyRole::free : BodyRole::solved;
}

/// Joints that hold something awake, in the order of their slots: what follows costs nothing for those that sleep.
void listActiveJoints(WorldState& world) {
    world.activeJoints.clear();
    if (world.joints.size() == 0) { return; }
    const auto isAwake = [&world](std::uint32_t slot) {
        return world.bodies[slot].isDynamic() && world.bodies[slot].awake;
    };
    for (const std::uint32_t slot : world.awake) {
        if (!isAwake(slot)) { continue; }
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const Joint& joint = world.joints[index];
            const auto bodies = joint.allBodies();
            const bool isFirst = *std::find_if(bodies.begin(), bodies.end(), isAwake) == slot;
            if (joint.holds() && isFirst) { world.activeJoints.push_back(index); }
        }
    }
    std::sort(world.activeJoints.begin(), world.activeJoints.end());
}

}  // namespace

void assignRoles(WorldState& world, Real dt) {
    for (const std::uint32_t slot : world.awake) { resetBody(world, slot, dt); }
    for (const Contact& contact : world.contacts) {
        if (!contact.isSolid()) { continue; }
        ++world.counters.touching;
        Body& a = world.bodies[contact.bodyA];
        Body& b = world.bodies[contact.bodyB];
        noteContact(a, b, contact);
        noteContact(b, a, contact);
    }
    world.flyers.clear();
    for (const std::uint32_t slot : world.awake) {
        Body& body = world.bodies[slot];
        body.role = roleOf(world, body);
        if (body.role == BodyRole::flyer) { world.flyers.push_back(slot); }
        world.counters.freeBodies += body.role == BodyRole::free ? 1 : 0;
        world.counters.solvedBodies += body.role == BodyRole::solved ? 1 : 0;
    }
    world.counters.flyers = world.flyers.size();
    world.counters.awakeBodies = world.awake.size();
}

void findIslands(WorldState& world) {
    world.islands.reset(world.bodies.slotCount());
    const auto tie = [&world](std::uint32_t a, std::uint32_t b) {
        const Body& bodyA = world.bodies[a];
        const Body& bodyB = world.bodies[b];
        if (bodyA.isDynamic() && bodyB.isDynamic() && bodyA.awake && bodyB.awake) { world.islands.unite(a, b); }
    };
    for (const Contact& contact : world.contacts) {
        if (contact.isSolid()) { tie(contact.bodyA, contact.bodyB); }
    }
    listActiveJoints(world);
    for (const std::uint32_t i : world.activeJoints) {
        const auto bodies = world.joints[i].allBodies();
        const auto moves = [&world](std::uint32_t slot) { return world.bodies[slot].isDynamic(); };
        const auto first = std::find_if(bodies.begin(), bodies.end(), moves);
        for (const std::uint32_t other : bodies) { tie(*first, other); }
    }
    for (const std::uint32_t slot : world.awake) {
        const bool isRoot = world.bodies[slot].role == BodyRole::solved && world.islands.find(slot) == slot;
        world.counters.islands += isRoot ? 1 : 0;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
