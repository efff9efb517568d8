#include "settled.h"

#include <algorithm>
#include <cmath>

#include "effort.h"
#include "profile.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Speeds below this part of what gravity gives in a step: at 60 Hz on earth, 6 µm in ten seconds. A direct solve
/// leaves less than a thousandth of it.
constexpr Real kSpeedRatio = Real(1) / (1 << 18);
/// Overlaps, and gaps of what presses, below this part of the radius: a quarter more than a direct solve leaves as it
/// is. (With no more than that, what rounding found beyond it here and within it there was solved directly for ever,
/// and left as it was.)
constexpr Real kGapRatio = Real(5) / (1 << 22);
/// What impulses and pulls leave of each other on a body is below this part of its weight. (With sixteen times as much
/// a stack of 200 boxes moved by 12 µm before it was solved again, instead of by 0.1.) In float the impulses under 250
/// boxes are rounded to as much: higher ones are solved more often.
constexpr Real kPullRatio = Real(1) / (1 << 16);

/// The same for what hangs: speeds (0.2 mm/s at 60 Hz on earth), and what is left of the pulls.
constexpr Real kHangingRatio = Real(1) / (1 << 10);
constexpr std::int8_t kHangingDoublings = -3;

/// The speed of any point of a body is below the limit, and no torque turns it.
bool isStill(const Body& body, const BodyMotion& motion, Real speed) {
    const Real spin = std::fabs(motion.angularVelocity) * body.radius;
    return lengthSquared(motion.velocity) <= square(speed) && spin <= speed && body.torque == 0;
}

/// @return whether there are islands that may be settled
bool listCandidates(WorldState& world, Real gravityStep, Real dt) {
    bool any = false;
    const Real speed = kSpeedRatio * gravityStep;
    for (const std::uint32_t slot : world.awake) {
        IslandLoad& load = world.islandLoads[slot];
        load.effort.isSettled = load.bodies > 0 && load.effort.direct == DirectScope::all && load.joints == 0 &&
                                load.fastest <= square(speed);
        any = any || load.effort.isSettled;
    }
    if (!any) { return false; }
    world.islandPulls.resize(std::max<std::size_t>(world.islandPulls.size(), world.bodies.slotCount()));
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        IslandLoad& load = world.islandLoads[world.islands.find(slot)];
        if (!load.effort.isSettled || body.role != BodyRole::solved) { continue; }
        load.effort.isSettled = isStill(body, world.motions[slot], speed);
        world.islandPulls[slot] = (static_cast<Real>(body.mass) * dt) * accelerationOf(world, body);
    }
    return true;
}

/// Radius of the smaller one of the bodies that can move, metres.
Real movedRadius(const WorldState& world, const Contact& contact) {
    const Real a = world.bodies[contact.bodyA].radius;
    const Real b = world.bodies[contact.bodyB].radius;
    if (contact.dynamicA && contact.dynamicB) { return std::min(a, b); }
    return contact.dynamicA ? a : b;
}

/// Adds what a contact gave the bodies in the last step. @return whether it may stay as it is
bool weighContact(WorldState& world, const Contact& contact, Real subSteps) {
    const BodyMotion& a = world.motions[contact.bodyA];
    const Vec2 normal = rotate(a.pose.rotation, contact.manifold.normal);
    const Real gap = kGapRatio * movedRadius(world, contact);
    Real normalImpulse = 0;
    Real tangentImpulse = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const Real separation = contact.manifold.points[i].separation;
        const bool presses = contact.normalImpulse[i] > 0;
        if (separation < -gap || (presses && separation > gap)) { return false; }
        normalImpulse += contact.normalImpulse[i];
        tangentImpulse += contact.tangentImpulse[i];
    }
    const Vec2 impulse = subSteps * (normalImpulse * normal + tangentImpulse * rightPerp(normal));
    if (contact.dynamicA) { world.islandPulls[contact.bodyA] -= impulse; }
    if (contact.dynamicB) { world.islandPulls[contact.bodyB] += impulse; }
    return true;
}

void weighContacts(WorldState& world) {
    const auto subSteps = static_cast<Real>(subStepsOf(world.settings));
    for (const Contact& contact : world.contacts) {
        if (!contact.isSolid()) { continue; }
        Effort& effort = world.islandLoads[world.islands.find(contact.dynamicA ? contact.bodyA : contact.bodyB)].effort;
        if (!effort.isSettled) { continue; }
        const bool onKinematic = world.bodies[contact.bodyA].def.type == BodyType::kinematic ||
                                 world.bodies[contact.bodyB].def.type == BodyType::kinematic;
        effort.isSettled = !onKinematic && weighContact(world, contact, subSteps);
    }
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
    if (a.isDynamic()) { world.islandPulls[joint.bodyA] -= dt * joint.reactionForce; }
    if (b.isDynamic()) { world.islandPulls[joint.bodyB] += dt * joint.reactionForce; }
    return true;
}

}  // namespace

void markSettledIslands(WorldState& world, double dt) {
    const Real gravityStep = length(world.settings.gravity) * static_cast<Real>(dt);
    if (!listCandidates(world, gravityStep, static_cast<Real>(dt))) { return; }
    weighContacts(world);
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        Effort& effort = world.islandLoads[world.islands.find(slot)].effort;
        if (!effort.isSettled || body.role != BodyRole::solved) { continue; }
        const Real most = kPullRatio * static_cast<Real>(body.mass) * gravityStep;
        effort.isSettled = lengthSquared(world.islandPulls[slot]) <= square(most);
    }
    for (const std::uint32_t slot : world.awake) {
        Effort& effort = world.islandLoads[slot].effort;
        if (effort.isSettled) { effort = {.direct = DirectScope::all, .isSettled = true}; }
    }
}

void slowHangingIslands(WorldState& world, double dt) {
    const auto step = static_cast<Real>(dt);
    const Real speed = kHangingRatio * length(world.settings.gravity) * step;
    // Their effort tells what is still in question: those that move keep theirs.
    world.islandPulls.resize(std::max<std::size_t>(world.islandPulls.size(), world.bodies.slotCount()));
    world.chainLengths.assign(world.bodies.slotCount(), 0);  // now: 1 where an island hangs still
    for (const std::uint32_t slot : world.awake) { world.chainLengths[slot] = isDirectChain(world.islandLoads[slot]); }
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        std::uint32_t& hangs = world.chainLengths[world.islands.find(slot)];
        if (hangs == 0 || body.role != BodyRole::solved) { continue; }
        hangs = isStill(body, world.motions[slot], speed) ? 1 : 0;
        world.islandPulls[slot] = (static_cast<Real>(body.mass) * step) * accelerationOf(world, body);
    }
    for (const std::uint32_t i : world.activeJoints) {
        const Joint& joint = world.joints[i];
        const std::uint32_t moved = world.bodies[joint.bodyA].isDynamic() ? joint.bodyA : joint.bodyB;
        std::uint32_t& hangs = world.chainLengths[world.islands.find(moved)];
        hangs = hangs != 0 && weighHinge(world, joint, step) ? 1 : 0;
    }
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        std::uint32_t& hangs = world.chainLengths[world.islands.find(slot)];
        if (hangs == 0 || body.role != BodyRole::solved) { continue; }
        hangs = lengthSquared(world.islandPulls[slot]) <= square(static_cast<Real>(body.mass) * speed) ? 1 : 0;
    }
    for (const std::uint32_t slot : world.awake) {
        if (world.chainLengths[slot] != 0) { world.islandLoads[slot].effort.doublings = kHangingDoublings; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
