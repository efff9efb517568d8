#include "settled.h"

#include <algorithm>
#include <cmath>

#include "profile.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Speeds below this part of what gravity gives in a step: at 60 Hz on earth, 6 µm in ten seconds. A direct solve
/// leaves less than a thousandth of it.
constexpr Real kSpeedRatio = Real(1) / (1 << 18);
/// Overlaps, and gaps of what presses, below this part of the radius: what a direct solve leaves as it is.
constexpr Real kGapRatio = Real(1) / (1 << 20);
/// What impulses and pulls leave of each other on a body is below this part of its weight. (With sixteen times as much
/// a stack of 200 boxes moved by 12 µm before it was solved again, instead of by 0.1.) In float the impulses under 250
/// boxes are rounded to as much: higher ones are solved more often.
constexpr Real kPullRatio = Real(1) / (1 << 16);

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

}  // namespace swept::inline SWEPT_PRECISION
