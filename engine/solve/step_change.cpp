#include "step_change.h"

#include <algorithm>

#include "../bodies/awake.h"
#include "../bodies/world_boxes.h"
#include "../contacts/impulse_growth.h"
#include "../contacts/pairs_of_shapes.h"
#include "../contacts/parked_contacts.h"
#include "../state/profile.h"
#include "joint_growth.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Seconds by which the closing time goes back in a second, at most: from 60 Hz to much shorter steps it takes half of
/// one. Errors at rest go by its square, so they shrink in 16 of its own lengths, many times what a spring takes to
/// follow: nothing is pushed, all sinks out slowly.
constexpr double kClosingPace = 1.0 / 32;
/// s. What longer steps leave is not waited for: springs of seconds would give way by metres.
constexpr double kLongestClosing = 1.0 / 30;
/// s. It does not go back at all as long as one of the last steps was as long: what rests on springs that follow the
/// ups and downs of steps goes up and down with them. It may be twice this until it does.
constexpr double kHoldTime = 4;
/// s. Nor do longer steps hold it.
constexpr double kLongestHeld = 1.0 / 15;
/// What takes so many times as long as all of them is a hitch. When the next one is another it counts, as this much.
constexpr double kHitchRatio = 1.5;
/// Impulses of joints become those of the new step where that is up to so many times as long, or shorter. Grown in
/// proportion farther, a jerk would be as well (a net that hung in steps of 1/60 s and 0.1 ms by turns rose by half a
/// metre), unless they are still those of a long step (remainder_loads.h).
constexpr Real kMostJointGrowth = 2;

void noteStep(RecentSteps& recent, double before, double dt) {
    recent.time += dt;
    if (recent.time > kHoldTime) { recent = {.longestBefore = recent.longest}; }
    const double known = std::max(recent.longest, recent.longestBefore);
    const double bound = kHitchRatio * (known > 0 ? known : std::min(before, dt));
    if (dt < bound || before >= bound) { recent.longest = std::max(recent.longest, std::min(dt, bound)); }
}

/// Of all contacts that are not parked. Those keep their impulses until they come back (parked_contacts.h), so that
/// sleep costs nothing. So do joints that sleep: theirs are found anew within a step.
void scaleContacts(WorldState& world, Real factor) {
    for (const ContactProbe& probe : world.probes) {
        Contact& contact = world.contacts[probe.contact];
        scaleToSubStep(contact, factor, wasStill(contact, world.bodies[contact.bodyA], world.bodies[contact.bodyB]),
                       world.remainder.isOne);
    }
}

bool holdsAwake(const WorldState& world, const JointTie& tie) {
    return tie.holds && (world.bodies[tie.bodyA].awake || world.bodies[tie.bodyB].awake);
}

void scaleJoints(WorldState& world, Real factor) {
    if (factor > kMostJointGrowth && !world.remainder.isOne) { return; }
    for (const std::uint32_t i : world.activeJoints) {  // of the last step: some may be gone since, or asleep
        if (holdsAwake(world, world.jointTies[i])) { scaleStart(world.joints[i], factor); }
    }
}

}  // namespace

void changeStep(WorldState& world, double dt) {
    const double before = world.lastDt;
    releaseAllHeld(world);  // to be in balance with impulses of this step, it may be that at once
    if (before > 0) {
        const auto factor = static_cast<Real>(dt / before);
        scaleContacts(world, factor);
        scaleJoints(world, factor);
    }
    world.lastDt = dt;
    if (before > 0) { unparkContacts(world); }
    if (!(dt > before)) { return; }  // the first of all is longer, too: no box knew it
    for (const std::uint32_t slot : world.awake) { reachWithVelocity(world, slot); }
}

void changeSubSteps(WorldState& world, int before) {
    const int after = subStepsOf(world.settings);
    if (before == after || !(world.lastDt > 0)) { return; }
    const double ratio = static_cast<double>(after) / before;
    closeUpPairs(world);  // what comes back stands behind the other contacts: all candidates get other places
    scaleContacts(world, static_cast<Real>(1 / ratio));
    unparkContacts(world);
    world.closingStretch = std::max(1.0, world.closingStretch * ratio);
}

double closingTimeAfter(WorldState& world, double before, double dt) {
    RecentSteps& recent = world.recentSteps;
    noteStep(recent, before, dt);
    const double held = std::min(std::max(recent.longest, recent.longestBefore), kLongestHeld);
    const bool wasHeld = world.closingTime > before;  // or it was that of a step, however long
    const double last = wasHeld ? world.closingTime : std::min(world.closingTime, kLongestClosing);
    return std::max({dt, held, last - kClosingPace * dt});
}

double closingStretchOf(const WorldState& world, double dt) {
    return std::max(1.0, world.closingStretch - kClosingPace * dt / world.closingTime);
}

}  // namespace swept::inline SWEPT_PRECISION
