#include "step_change.h"

#include <algorithm>

#include "../contacts/pairs_of_shapes.h"
#include "../contacts/parked_contacts.h"
#include "../islands/held_islands.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Seconds by which the closing time goes back in a second, at most: from 60 Hz to much shorter steps it takes half of
/// one. Errors at rest go by its square, so they shrink in 16 of its own lengths, many times what a spring takes to
/// follow: nothing is pushed, all sinks out slowly.
constexpr double kClosingPace = 1.0 / 32;
/// s. What longer steps leave is not waited for: springs of seconds would give way by metres.
constexpr double kLongestClosing = 1.0 / 30;

/// Impulses under what moves grow no more than so many times at once: what was pressed in two short steps may still
/// have been a blow.
constexpr Real kMostGrowth = 4;

/// Of the impulses of a contact, as the step grows.
/// @return at least 1, at most `factor`
Real growthOf(const WorldState& world, const Contact& contact, Real factor) {
    const auto wasStill = [&world](std::uint32_t slot) { return world.bodies[slot].soughtSteps > 0; };
    if ((contact.dynamicA && wasStill(contact.bodyA)) || (contact.dynamicB && wasStill(contact.bodyB))) {
        return factor;  // there are no blows
    }
    return contact.pressedOn ? std::min(factor, kMostGrowth) : Real(1);
}

void scaleContacts(WorldState& world, Real factor) {
    for (const ContactProbe& probe : world.probes) {
        Contact& contact = world.contacts[probe.contact];
        const Real own = factor > 1 ? growthOf(world, contact, factor) : factor;
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.manifold.count); ++k) {
            contact.normalImpulse[k] *= own;
            contact.tangentImpulse[k] *= own;
        }
        if (contact.rolls()) { contact.rollingImpulse() *= own; }
    }
}

/// What sleeps keeps its impulses, of the step with which it fell asleep, so that it costs nothing. So do joints:
/// theirs are found anew within a step, and grown in proportion a jerk would be as well (a net that hung in steps of
/// 1/60 s and 0.1 ms by turns rose by half a metre).
void scaleImpulses(WorldState& world, double dt) {
    if (!(world.lastDt > 0)) { return; }
    unparkContacts(world);
    scaleContacts(world, static_cast<Real>(dt / world.lastDt));
}

}  // namespace

void changeStep(WorldState& world, double dt) {
    releaseAllHeld(world);  // to be in balance with impulses of this step, it may be that at once
    scaleImpulses(world, dt);
    const bool isLonger = dt > world.lastDt;  // the first of all is, too: no box knew it
    world.lastDt = dt;
    if (!isLonger) { return; }
    for (const std::uint32_t slot : world.awake) { reachWithVelocity(world, slot); }
}

void changeSubSteps(WorldState& world, int before, int after) {
    if (before == after || !(world.lastDt > 0)) { return; }
    const double ratio = static_cast<double>(after) / before;
    closeUpPairs(world);  // what comes back stands behind the other contacts: all candidates get other places
    unparkContacts(world);
    scaleContacts(world, static_cast<Real>(1 / ratio));
    world.closingStretch = std::max(1.0, world.closingStretch * ratio);
}

double closingTimeOf(const WorldState& world, double dt) {
    return std::max(dt, std::min(world.closingTime, kLongestClosing) - kClosingPace * dt);
}

double closingStretchOf(const WorldState& world, double dt) {
    return std::max(1.0, world.closingStretch - kClosingPace * dt / world.closingTime);
}

}  // namespace swept::inline SWEPT_PRECISION
