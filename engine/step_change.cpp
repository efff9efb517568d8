#include "step_change.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "held_islands.h"
#include "joint_builder.h"
#include "parked_contacts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Seconds by which the closing time goes back in a second, at most: from 60 Hz to much shorter steps it takes half of
/// one. Errors at rest go by its square, so they shrink in 16 of its own lengths, many times what a spring takes to
/// follow: nothing is pushed, all sinks out slowly.
constexpr double kClosingPace = 1.0 / 32;
/// s. What longer steps leave is not waited for: springs of seconds would give way by metres.
constexpr double kLongestClosing = 1.0 / 30;

/// Impulses under what moves grow no more than so many times at once: what was pressed in two short steps may still have
/// been a blow.
constexpr Real kMostGrowth = 4;

/// What a constraint carries from one sub-step to the next, but for the springs' part, which each of them finds anew.
template <class Constraint>
void scaleMemory(Constraint& c, Real factor) {
    const auto scale = [factor](auto& impulse) { impulse = factor * impulse; };
    if constexpr (requires { c.linearImpulse; }) { scale(c.linearImpulse); }
    if constexpr (requires { c.angularImpulse; }) { scale(c.angularImpulse); }
    if constexpr (requires { c.heldImpulse; }) { scale(c.heldImpulse); }
    if constexpr (requires { c.rigidImpulse; }) { scale(c.rigidImpulse); }
    if constexpr (requires { c.lowerImpulse; }) { scale(c.lowerImpulse); }
    if constexpr (requires { c.upperImpulse; }) { scale(c.upperImpulse); }
    if constexpr (requires { c.motorImpulse; }) { scale(c.motorImpulse); }
    if constexpr (requires { c.suspension; }) { scaleMemory(c.suspension, factor); }
    if constexpr (std::is_same_v<Constraint, GearConstraint>) { scale(c.impulse); }
    if constexpr (requires { c.tension; }) { scale(c.tension); }
}

void scaleJoint(Joint& joint, Real factor) {
    std::visit(
        [factor](auto& part) {
            if constexpr (requires { part.memory; }) { scaleMemory(part.memory, factor); }
        },
        joint.parts);
    HingeMemory& hinge = joint.hinge;
    hinge = {factor * hinge.point, factor * hinge.lower, factor * hinge.upper, factor * hinge.motor};
}

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
    }
}

/// What sleeps keeps its impulses, of the step with which it fell asleep, so that it costs nothing.
void scaleImpulses(WorldState& world, double dt) {
    if (!(world.lastDt > 0)) { return; }
    const auto factor = static_cast<Real>(dt / world.lastDt);
    unparkContacts(world);
    scaleContacts(world, factor);
    // Nothing tells what a joint carries from the jerk that it was given.
    if (!(factor < 1)) { return; }
    for (const std::uint32_t i : world.activeJoints) { scaleJoint(world.joints[i], factor); }
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

double closingTimeOf(const WorldState& world, double dt) {
    return std::max(dt, std::min(world.closingTime, kLongestClosing) - kClosingPace * dt);
}

}  // namespace swept::inline SWEPT_PRECISION
