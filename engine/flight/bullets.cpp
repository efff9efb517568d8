#include "bullets.h"

#include <algorithm>
#include <cmath>

#include "../bodies/awake.h"
#include "../islands/reset_bodies.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "bullet_impact.h"
#include "bullet_meetings.h"
#include "bullet_paths.h"
#include "bullet_search.h"
#include "curved_path.h"
#include "flight_state.h"
#include "free_path.h"
#include "take_along.h"
#include "turning_ride.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies keep no lists of their contacts: one look at all that touch does for all bodies.
void listPressed(WorldState& world) {
    BulletWork& work = world.bulletWork;
    std::fill(work.pressed.begin(), work.pressed.end(), std::uint8_t{0});
    for (const TouchingPair& pair : world.touching) {
        if (!world.contacts[pair.contact].pressed) { continue; }
        work.pressed[pair.bodyA] = work.pressed[pair.bodyB] = 1;
    }
    work.isPressedListed = true;
}

/// Of a body that was solved, whether a contact did anything to it in this step: what it had may have been in reach
/// alone.
bool wasPressed(WorldState& world, std::uint32_t slot) {
    if (!world.bulletWork.isPressedListed) { listPressed(world); }
    return world.bulletWork.pressed[slot] != 0;
}

void setVelocity(BodyMotion& motion, const FreeVelocity& velocity) {
    motion.velocity = velocity.linear;
    motion.angularVelocity = velocity.angular;
}

/// Its velocity is that of the end of the step, with all that forces and damping do till then, which its flight does
/// once more. Of what is on the ground gravity does nothing; else the solver did what else there was.
void takeBackRest(WorldState& world, BulletPartner& partner, double time) {
    Flight& flight = partner.flight;
    const Body& body = flight.body();
    BodyMotion& motion = flight.motion;
    if (body.role == BodyRole::free) {
        const Drift whole = driftOf(world, body, flight.dt);
        const double turn = partner.path.a1 - partner.path.a0;
        setVelocity(motion, velocityBefore(partner.path.c1 - partner.path.c0, turn, whole));
        setVelocity(motion, velocityAfter(motion, driftOf(world, body, time)));
        return;
    }
    if (body.role == BodyRole::solved && !wasPressed(world, flight.slot)) {
        // Not by its path: a solver that goes in sub-steps leaves the parabola.
        setVelocity(motion, velocityBefore(motion, driftOf(world, body, flight.dt - time)));
        return;
    }
    const auto rest = static_cast<Real>(flight.dt - time);
    motion.velocity -= rest * body.inverseMass * body.force;
    motion.angularVelocity -= rest * angularAccelerationOf(body);
}

/// From the solver's hands, or from sleep, into flight: with the velocity that it has at this time.
void takeOff(WorldState& world, BulletPartner& partner, double time) {
    Flight& flight = partner.flight;
    const Body& body = flight.body();
    const BodyMotion now = motionAt(partner.path, fractionAt(partner, time), body.localCenter);
    flight.motion.center = now.center;
    flight.motion.angle = now.angle;
    flight.motion.pose = now.pose;
    if (body.awake) { takeBackRest(world, partner, time); }
    flight.elapsed = time;
    partner.flies = true;
}

void bringTo(WorldState& world, BulletPartner& partner, double time) {
    if (!partner.flies && !partner.tied) {
        takeOff(world, partner, time);
        return;
    }
    if (partner.flies) {
        const double rest = partner.flight.remaining();
        advance(partner.flight, partner.path, rest > 0 ? std::min((time - partner.flight.elapsed) / rest, 1.0) : 1);
        partner.flight.elapsed = time;
        return;
    }
    const BodyMotion now = motionAt(partner.path, fractionAt(partner, time), partner.flight.body().localCenter);
    partner.flight.motion.center = now.center;
    partner.flight.motion.angle = now.angle;
    partner.flight.motion.pose = now.pose;
}

/// It rides on with the other one to the end of the step: what it would have done on its own is lost.
void ride(BulletPartner& rider, const BulletPartner& carrier, double time) {
    enterLedger(rider.flight, LostTimeReason::clamp);
    rider.path = pathWith(rider, carrier, time);
    rider.pathFrom = time;
    rider.flies = false;
    rider.tied = rider.stopped = true;
}

/// Counts one impact more. @return whether it was one too many
bool spendImpact(BulletPartner& partner) {
    return isExhausted(partner.flight, partner.impacts++, LostTimeReason::budget);
}

/// It stays where it is, unless something kinematic takes it along.
void stop(BulletPartner& partner, double time, LostTimeReason reason) {
    const Flight& flight = partner.flight;
    enterLedger(flight, reason);
    BodyMotion end = flight.motion;
    takeAlong(*flight.world, flight.slot, end, time, flight.dt, *flight.scratch);
    partner.path = {.localCenter = toDouble(flight.body().localCenter),
                    .c0 = flight.motion.center,
                    .c1 = end.center,
                    .a0 = flight.motion.angle,
                    .a1 = end.angle};
    partner.pathFrom = time;
    partner.flies = false;
    partner.tied = partner.stopped = true;
}

/// What a member of this moment met that does not get out of the way in this step; null: nothing.
const BulletPartner* tiedBeside(WorldState& world, std::uint32_t slot) {
    for (const BulletMeeting& pair : world.bulletWork.together) {
        if (pair.first != slot && pair.second != slot) { continue; }
        const BulletPartner& other = partnerIn(world.bulletWork, pair.first == slot ? pair.second : pair.first);
        if (!other.flies && other.tied) { return &other; }
    }
    return nullptr;
}

bool isFast(const BulletPartner& partner) {
    const Body& body = partner.flight.body();
    const Sweep& path = partner.path;
    const double turned = std::fabs(path.a1 - path.a0) * static_cast<double>(body.radius);
    return length(path.c1 - path.c0) + turned > static_cast<double>(kFastRatio * body.extent);
}

void leave(BulletPartner& partner) {
    partner.tied = false;
    partner.left = true;
}

/// Of two that are tied, both on the ways that the solver gave them, a bullet leaves its own; and so does one in the
/// way of what left.
void untie(BulletWork& work) {
    for (const BulletMeeting& pair : work.together) {
        BulletPartner& first = partnerIn(work, pair.first);
        BulletPartner& second = partnerIn(work, pair.second);
        const bool isFirstTied = first.tied;
        if (mayLeave(first) && (second.tied || second.left || isFast(first))) { leave(first); }
        if (mayLeave(second) && (isFirstTied || first.left || isFast(second))) { leave(second); }
    }
}

/// All meetings of this moment.
void meet(WorldState& world, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    const double time = work.together.front().time;
    listMembers(work);
    untie(work);
    for (const std::uint32_t index : work.members) { bringTo(world, work.partners[index], time); }
    collideBodies(world, scratch);
    scratch.counters.impacts += work.together.size();
    for (const std::uint32_t index : work.members) {
        BulletPartner& partner = work.partners[index];
        partner.moved = true;
        if (!partner.flies) { continue; }
        notePose(partner.flight);
        resolveStanding(partner.flight);
        const BulletPartner* const tied = tiedBeside(world, partner.flight.slot);
        if (tied != nullptr && partner.impacts > 1) {
            ride(partner, *tied, time);
        } else if (spendImpact(partner)) {
            stop(partner, time, LostTimeReason::budget);
        }
    }
    lookAhead(world, work.members, scratch);
}

void bounce(WorldState& world, const BulletMeeting& meeting, FlightScratch& scratch) {
    BulletPartner& partner = partnerIn(world.bulletWork, meeting.first);
    bringTo(world, partner, meeting.time);
    if (spendImpact(partner)) {
        stop(partner, partner.flight.elapsed, LostTimeReason::budget);
    } else {
        const bool isHit = resolveStanding(partner.flight);
        notePose(partner.flight);
        ++scratch.counters.impacts;
        if (isHit && partner.flight.stops) { stop(partner, partner.flight.elapsed, LostTimeReason::stop); }
    }
    world.bulletWork.members.assign(1, world.bulletWork.indices[meeting.first]);
    lookAhead(world, world.bulletWork.members, scratch);
}

/// To the end of the step. @pre awake
void store(WorldState& world, BulletPartner& partner) {
    BodyMotion& motion = world.motions[partner.flight.slot];
    if (partner.flies) {
        if (partner.flight.remaining() > 0) { advance(partner.flight, partner.path, 1); }
        endRide(partner.flight);
        limitSpeed(partner.flight);
        motion = partner.flight.motion;
        rememberGround(partner.flight, world.bodies[partner.flight.slot]);
        return;
    }
    limitSpeed(partner.flight);
    motion = motionAt(partner.path, 1, partner.flight.body().localCenter);
    motion.velocity = partner.flight.motion.velocity;
    motion.angularVelocity = partner.flight.motion.angularVelocity;
}

void storeAll(WorldState& world, Real dt) {
    constexpr std::size_t kGrain = 32;
    RawVector<BulletPartner>& partners = world.bulletWork.partners;
    // What sleeps has begun no step lately: where it stands is where this one began.
    const std::size_t before = world.awake.size();
    for (const BulletPartner& partner : partners) {
        if (!partner.moved) { continue; }
        wake(world, partner.flight.slot);
        Body& body = world.bodies[partner.flight.slot];
        body.restTime = 0;  // however little of the step was left for it to move in
        body.restSteps = 0;
    }
    resetBodies(world, std::span(world.awake).subspan(before), dt);
    world.loops->run(partners.size(), kGrain, [&](std::size_t begin, std::size_t end, int worker) {
        for (BulletPartner& partner : std::span(partners).subspan(begin, end - begin)) {
            partner.flight.scratch = &world.flightScratch[static_cast<std::size_t>(worker)];
            if (partner.moved) { store(world, partner); }
        }
    });
}

}  // namespace

void flyBullets(WorldState& world, double dt) {
    findPartners(world, dt);
    BulletWork& work = world.bulletWork;
    FlightScratch& scratch = world.flightScratch[0];
    for (BulletPartner& partner : work.partners) { partner.flight.scratch = &scratch; }  // from here on, on one thread
    while (takeMeetings(world)) {
        if (work.together.front().isPair()) {
            meet(world, scratch);
        } else {
            bounce(world, work.together.front(), scratch);
        }
    }
    storeAll(world, static_cast<Real>(dt));
    world.counters.sweeps += work.partners.size();
    std::erase_if(world.flyers, [&](std::uint32_t slot) { return work.indices[slot] != kNoIndex; });
}

}  // namespace swept::inline SWEPT_PRECISION
