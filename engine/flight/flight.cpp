#include "flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "../bodies/body_form.h"
#include "../contacts/ghosts.h"
#include "../contacts/hit_event.h"
#include "../modes/modes.h"
#include "../solve/constraint_builder.h"
#include "../solve/squeezed_bodies.h"
#include "../state/tolerances.h"
#include "chain_crossing.h"
#include "curved_path.h"
#include "flight_contacts.h"
#include "flight_state.h"
#include "flush_impacts.h"
#include "free_path.h"
#include "sweep_obstacles.h"
#include "sweep_tolerances.h"
#include "take_along.h"
#include "turning_ride.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// @return whether it was a hit
bool report(Flight& flight, const ContactConstraint& constraint) {
    if (!(impactSpeed(constraint) > flight.threshold())) { return false; }
    const FlightObstacle& obstacle = flight.scratch->obstacles[constraint.source];
    flight.scratch->events.push_back(hitOf(*flight.world, obstacle.other, obstacle.own, constraint,
                                           flight.motion.center, flight.elapsed / flight.dt));
    return true;
}

/// What the body is pressed against, and does not bounce off, carries it: it may sag there until its next impact.
void noteCarrier(Flight& flight, const ContactConstraint& constraint) {
    const Real pull = -dot(accelerationOf(*flight.world, flight.body()), constraint.normal);
    if (!(pull > 0) || impactSpeed(constraint) > flight.threshold()) { return; }
    const auto isSame = [&](Vec2 normal) { return dot(normal, constraint.normal) > kSameNormal; };
    const auto last = flight.carriers.begin() + flight.carrierCount;
    if (last == flight.carriers.end() || std::any_of(flight.carriers.begin(), last, isSame)) { return; }
    flight.carriers[static_cast<std::size_t>(flight.carrierCount++)] = constraint.normal;
}

/// An elastic blow gives twice the speed of what strikes; a little more, so that rounding cuts none.
constexpr Real kMostBounceGain = Real(2.25);

/// The fastest that something kinematic goes where the body met it. (Between two that close, what bounces with e gets
/// (1 + e) / (1 - e) times as fast as these in the end: up to `kLivelyRestitution` less than something squeezed may;
/// beyond, what each bounce gives counts.) @pre its constraints are those of now
void noteLead(Flight& flight) {
    const FlightScratch& scratch = *flight.scratch;
    for (const ContactConstraint& constraint : scratch.constraints) {
        if (constraint.slotA == kFixedSlot) { continue; }
        const Vec2 velocity = velocityAt(scratch.states[constraint.slotA], constraint.points[0].anchorA);
        const Real lead = length(velocity);
        flight.lead = std::max(flight.lead, lead);
        if (constraint.restitution > kLivelyRestitution) { flight.bounceGain += kMostBounceGain * lead; }
    }
}

/// What was met just now, and along whose normal the path only leads away, however the body turns, is not met again:
/// the separation along that axis grows as the centre goes, less what the turn may bring. It is still there for what
/// it hides: a body that falls along a wall of flush pieces meets the top of each.
void clearWhatIsLeft(const Flight& flight, const Sweep& sweep) {
    FlightScratch& scratch = *flight.scratch;
    for (const MetGround& met : scratch.met) {
        const auto isSame = [&](const FlightObstacle& obstacle) {
            return met.own == obstacle.own && met.other == obstacle.other;
        };
        const auto obstacle = std::find_if(scratch.obstacles.begin(), scratch.obstacles.end(), isSame);
        if (obstacle == scratch.obstacles.end()) { continue; }
        const DVec2 normal = toDouble(met.normal);
        const double slowest = dot(sweep.c1 - sweep.c0, normal) - std::fabs(dot(sweep.k, normal));
        const double turning = std::fabs(sweep.a1 - sweep.a0) * turningArm(flight.world->shapes[obstacle->own]);
        obstacle->isClear = obstacle->isClear || slowest >= turning;
    }
    scratch.met.clear();
}

/// Impacts beyond `maxImpacts` are for a budget of lost time, up to this many times as many.
constexpr std::int64_t kMostTimesMaxImpacts = 16;
/// However many `maxImpacts` are asked for, so many have to take a flyer on by this part of the step: they are for what
/// bounces (so a step has room for 65 536), and not for what is crushed between two walls, which sink into it by a
/// rounding with each.
constexpr int kImpactsToGetOn = 64;
constexpr double kLeastGain = 1.0 / 1024;

/// For the rest of the step, which is lost.
void holdHere(Flight& flight, LostTimeReason reason) {
    enterLedger(flight, reason);
    takeAlong(*flight.world, flight.slot, flight.motion, flight.elapsed, flight.dt, *flight.scratch);
}

/// Looks every so many impacts, and notes how far it was then, whether it hardly got on since the last look.
bool lookIfStuck(const Flight& flight, int impacts, double& atLastLook) {
    if (impacts == 0 || impacts % kImpactsToGetOn != 0 || impacts >= flight.world->settings.maxImpacts) {
        return false;
    }
    return flight.elapsed - std::exchange(atLastLook, flight.elapsed) < kLeastGain * flight.dt;
}

/// With more shapes than this in its way, a flyer looks ahead only so many times as far as it was to its last impact:
/// along a curve of many pieces each impact would ask all that the rest of the step may meet.
constexpr std::size_t kManyObstacles = 16;
constexpr double kTimesAhead = 4;

/// Advances, and knows what it crosses there.
void goOn(Flight& flight, const Sweep& sweep, double fraction) {
    FlightScratch& scratch = *flight.scratch;
    if (!scratch.chains.fromBehind.empty() || !scratch.chains.crossings.empty()) {
        noteCrossings(*flight.world, flight.slot, sweep, flight.elapsed, flight.dt, fraction, scratch);
    }
    advance(flight, sweep, fraction);
}

/// Flies until the step is used up or the budget is.
void flyThrough(Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    resolveStart(flight);
    double atLastLook = flight.elapsed;
    double ahead = flight.dt;
    for (int impacts = 0; flight.remaining() > 0;) {
        const double share = std::min(ahead / flight.remaining(), 1.0);
        const Sweep sweep = sweepOf(flight);
        const FirstImpact first = nextImpact(flight, sweep, share, share);
        if (!first.hit) {
            goOn(flight, sweep, share);
            if (share < 1) {
                ahead *= 2;
                continue;
            }
            endRide(flight);
            return;
        }
        const auto reason = first.fraction > 0 ? LostTimeReason::budget : LostTimeReason::stuck;
        if (isExhausted(flight, impacts, reason)) { return holdHere(flight, reason); }
        if (lookIfStuck(flight, impacts, atLastLook)) { return holdHere(flight, LostTimeReason::stuck); }
        const double time = first.fraction * flight.remaining();
        ahead = scratch.obstacles.size() > kManyObstacles && time > 0 ? kTimesAhead * time : flight.dt;
        goOn(flight, sweep, first.fraction);
        const bool isHit = resolveHere(flight);
        notePose(flight);
        ++impacts;
        ++scratch.counters.impacts;
        if (isHit && flight.stops) { return holdHere(flight, LostTimeReason::stop); }
    }
}

}  // namespace

Real Flight::threshold() const { return bounceThreshold(*world, body(), static_cast<Real>(dt)); }

Flight flightOf(WorldState& world, std::uint32_t slot, double dt, FlightScratch& scratch) {
    Flight flight{.world = &world, .slot = slot, .scratch = &scratch, .motion = world.motions[slot], .dt = dt};
    flight.metLast = groundOfStepBefore(flight.body(), flight.motion.center);
    flight.stops = modeOf(world, world.bodies[slot]) == ContinuousMode::stop;
    // What stopped there in an earlier step may be anywhere by now.
    std::erase_if(scratch.met, [&](const MetGround& met) { return world.shapes[met.own].body == slot; });
    return flight;
}

Sweep sweepOf(const Flight& flight) {
    const Body& body = flight.body();
    return freePath(body, flight.motion, driftOf(*flight.world, body, flight.remaining()));
}

void advance(Flight& flight, const Sweep& sweep, double fraction) {
    const Body& body = flight.body();
    const double time = fraction * flight.remaining();
    const FreeVelocity after = velocityAfter(flight.motion, driftOf(*flight.world, body, time));
    flight.motion = motionAt(sweep, fraction, body.localCenter);
    flight.motion.velocity = after.linear;
    flight.motion.angularVelocity = after.angular;
    flight.elapsed = fraction >= 1 ? flight.dt : std::min(flight.elapsed + time, flight.dt);  // but for rounding
}

FirstImpact nextImpact(const Flight& flight, const Sweep& sweep, double limit, double ahead) {
    findObstacles(*flight.world, flight.slot, ahead < 1 ? part(sweep, 0, ahead) : sweep, flight.elapsed,
                  *flight.scratch);
    clearWhatIsLeft(flight, sweep);
    const auto count = static_cast<std::size_t>(flight.carrierCount);
    if (count > 0) { allowSag(*flight.world, {flight.carriers.data(), count}, flight.elapsed, *flight.scratch); }
    if (flight.ride.sag > 0) { allowRide(*flight.world, flight.ride, flight.elapsed, *flight.scratch); }
    return firstImpact(*flight.world, sweep, flight.elapsed, flight.dt, *flight.scratch, limit);
}

bool resolveHere(Flight& flight) {
    FlightScratch& scratch = *flight.scratch;
    const Body& body = flight.body();
    scratch.states.assign(2, {});
    scratch.inertias.assign(2, {});
    scratch.order.clear();
    const DVec2 center = flight.motion.center;
    listMet(flight);
    if (scratch.constraints.empty()) { return false; }
    scratch.states[kFlyerSlot].velocity = flight.motion.velocity;
    scratch.states[kFlyerSlot].angularVelocity = flight.motion.angularVelocity;
    scratch.inertias[kFlyerSlot] = {body.inverseMass, body.inverseInertia};
    for (ContactConstraint& constraint : scratch.constraints) {
        prepareContact(constraint, scratch.inertias);
        scratch.order.push_back(&constraint);
    }
    const bool slides = flight.ride.body != kNoIndex && slidesOn(flight);
    mergeFlushImpacts(flight);
    reflectOrStop(scratch, flight.threshold());
    const Vec2 before = std::exchange(flight.motion.velocity, scratch.states[kFlyerSlot].velocity);
    flight.motion.angularVelocity = scratch.states[kFlyerSlot].angularVelocity;
    for (const ContactConstraint* constraint : scratch.order) { noteCarrier(flight, *constraint); }
    partFlushImpacts(scratch);
    bool anyHit = false;
    for (const ContactConstraint& constraint : scratch.constraints) {
        anyHit = (!slides && report(flight, constraint)) || anyHit;
    }
    const bool meetsKinematic = scratch.states.size() > kFlyerSlot + 1;
    if (meetsKinematic) { noteLead(flight); }
    if (meetsKinematic || flight.ride.body != kNoIndex) { followRide(flight, slides); }
    goAlongCurve(flight, before, toReal(flight.motion.center - center));
    return anyHit;
}

void reflectOrStop(FlightScratch& scratch, Real threshold) {
    const SolverBodies bodies{scratch.states, scratch.inertias};
    ImpactRule rule{.restitutionThreshold = threshold, .resolvePlastic = true};
    if (reflectImpacts(scratch.order, bodies, rule, kMaxImpactRounds, scratch.impact) < kMaxImpactRounds) { return; }
    rule.restitutionThreshold = std::numeric_limits<Real>::infinity();
    reflectImpacts(scratch.order, bodies, rule, kMaxImpactRounds, scratch.impact);
}

DVec2 partingWay(const WorldState& world, const FlightObstacle& shapes, Real separation, double inverseMass,
                 Vec2 normal) {
    const double gap = targetOf(world, shapes) - static_cast<double>(separation);
    const double noise = toleranceOf(world, shapes) + static_cast<double>(roundingOf(world, shapes));
    if (!(gap > noise) || !(inverseMass > 0)) { return {}; }
    return (gap / inverseMass) * toDouble(normal);
}

bool resolveStanding(Flight& flight) {
    const DVec2 center = flight.motion.center;
    const double angle = flight.motion.angle;
    const Sweep standing{
        .localCenter = toDouble(flight.body().localCenter), .c0 = center, .c1 = center, .a0 = angle, .a1 = angle};
    findObstacles(*flight.world, flight.slot, standing, flight.elapsed, *flight.scratch);
    return resolveHere(flight);
}

void resolveStart(Flight& flight) {
    if (flight.body().hasContact) { resolveStanding(flight); }
}

void notePose(const Flight& flight) {
    flight.scratch->impactPoses.push_back({.body = flight.world->bodies.idOf(flight.slot),
                                           .position = flight.motion.pose.position,
                                           .angle = flight.motion.angle,
                                           .fraction = flight.elapsed / flight.dt});
}

/// Between something kinematic that comes and something else it has an impact after the other, each of which gives it
/// speed: those of a step all together give no more than a solve may.
void limitSqueezed(Flight& flight) {
    if (!(flight.lead > 0)) { return; }
    const Body& body = flight.body();
    const BodyMotion& before = flight.world->motions[flight.slot];
    const Real fall = length(accelerationOf(*flight.world, body)) * static_cast<Real>(flight.dt);
    const Real free = length(before.velocity) + fall + flight.bounceGain;
    shortenTo(flight.motion.velocity, mostSqueezedSpeed(free, flight.lead));
    const Real arm = gyrationOf(body);
    if (!(arm > 0)) { return; }
    const Real fallOfTurn = std::fabs(angularAccelerationOf(body)) * static_cast<Real>(flight.dt);
    const Real spun = arm * (std::fabs(before.angularVelocity) + fallOfTurn);
    shortenTo(flight.motion.angularVelocity, mostSqueezedSpeed(spun, flight.lead) / arm);
}

void limitSpeed(Flight& flight) {
    const Real speed = length(flight.motion.velocity);
    const Real limit = flight.world->settings.maxSpeed;
    if (!(speed > limit)) { return; }
    flight.motion.velocity = (limit / speed) * flight.motion.velocity;
    ++flight.scratch->counters.speedsLimited;
}

bool isExhausted(const Flight& flight, int impacts, LostTimeReason reason) {
    const WorldSettings& settings = flight.world->settings;
    if (impacts < settings.maxImpacts) { return false; }
    // More impacts do not free what is stuck.
    const bool isHopeless = reason == LostTimeReason::stuck || impacts >= kMostTimesMaxImpacts * settings.maxImpacts;
    return isHopeless || flight.body().lostTime + flight.remaining() <= settings.maxLostTime;
}

void enterLedger(const Flight& flight, LostTimeReason reason) {
    flight.scratch->lostTime.push_back(
        {.body = flight.world->bodies.idOf(flight.slot), .seconds = flight.remaining(), .reason = reason});
}

void fly(WorldState& world, std::uint32_t slot, double dt, FlightScratch& scratch) {
    Body& body = world.bodies[slot];
    if (flyClear(world, slot, dt)) {
        body.groundNormal = {};
        return;
    }
    Flight flight = flightOf(world, slot, dt, scratch);
    limitSpeed(flight);
    beginCrossings(world, slot, scratch);
    flyThrough(flight);
    endCrossings(scratch);
    limitSqueezed(flight);
    limitSpeed(flight);
    world.motions[slot] = flight.motion;
    rememberGround(flight, body);
}

}  // namespace swept::inline SWEPT_PRECISION
