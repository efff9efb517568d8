#include "bullets.h"

#include <algorithm>
#include <limits>

#include "../solver/impact.h"
#include "bullet_paths.h"
#include "constraint_builder.h"
#include "flight_state.h"
#include "hit_event.h"
#include "modes.h"
#include "step.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr BodySlot kFirstSlot = 1;
constexpr BodySlot kSecondSlot = 2;
/// Two points of a contact, and friction at each: more rounds change nothing.
constexpr int kPairRounds = 8;

bool isBullet(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    return body.isDynamic() && body.awake && body.def.bullet && modeOf(world, body) == ContinuousMode::subStep;
}

Real speedBound(const WorldState& world, std::uint32_t slot, Real dt) {
    const Body& body = world.bodies[slot];
    return length(world.motions[slot].velocity) +
           (body.isDynamic() ? dt * length(accelerationOf(world, body)) : Real(0));
}

/// Where a body may get within the step, whatever direction it is sent into.
Aabb realmOf(const WorldState& world, std::uint32_t slot, Real reach) {
    const Body& body = world.bodies[slot];
    const DVec2 center = body.awake ? body.startCenter : world.motions[slot].center;
    return grown(roundedOutward(center, center), reach + body.radius);
}

/// Bullets first; then what lies in their realm, and what is fast enough to get there.
void findCandidates(WorldState& world, Real dt) {
    std::vector<std::uint32_t>& found = world.bulletWork.candidates;
    found.clear();
    Real fastest = 0;
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].isDynamic()) { fastest = std::max(fastest, speedBound(world, slot, dt)); }
    }
    for (const std::uint32_t slot : world.awake) {
        if (!isBullet(world, slot)) { continue; }
        const Aabb realm = realmOf(world, slot, dt * (speedBound(world, slot, dt) + fastest));
        found.push_back(slot);
        world.broadphase->query(realm, [&](ProxyId id) {
            const Shape& shape = world.shapes[world.proxyShapes[static_cast<std::uint32_t>(id)]];
            if (world.bodies[shape.body].isDynamic() && !shape.def.sensor) { found.push_back(shape.body); }
            return true;
        });
        for (const std::uint32_t other : world.awake) {
            const Body& body = world.bodies[other];
            if (!body.isDynamic() || !body.fast || other == slot) { continue; }
            if (overlaps(realm, realmOf(world, other, dt * speedBound(world, other, dt)))) { found.push_back(other); }
        }
    }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

/// What it does in the rest of the step while nothing happens to it.
void lookAhead(BulletPartner& partner) {
    const Flight& flight = partner.flight;
    partner.pathFrom = flight.elapsed;
    partner.path = sweepOf(flight);
    const FirstImpact first = nextImpact(flight, partner.path);
    partner.nextImpact = first.hit ? flight.elapsed + first.fraction * flight.remaining() : kNever;
}

BulletPartner partnerOf(WorldState& world, std::uint32_t slot, double dt, FlightScratch& scratch) {
    const Body& body = world.bodies[slot];
    BulletPartner partner{.flight = flightOf(world, slot, dt, scratch), .path = {}};
    partner.isBullet = isBullet(world, slot);
    partner.tied = body.holdingJoints > 0 || body.touchesDynamic;
    partner.nextImpact = kNever;
    if (body.awake && body.role == BodyRole::flyer) {
        partner.flies = partner.moved = true;
        limitSpeed(partner.flight);
        resolveStanding(partner.flight);
        lookAhead(partner);
        return partner;
    }
    const BodyMotion& motion = world.motions[slot];
    partner.path = {.localCenter = toDouble(body.localCenter),
                    .c0 = body.awake ? body.startCenter : motion.center,
                    .c1 = motion.center,
                    .a0 = body.awake ? body.startAngle : motion.angle,
                    .a1 = motion.angle};
    return partner;
}

/// First impact of any two of their shapes from now on.
void predict(WorldState& world, BulletPair& pair, FlightScratch& scratch) {
    const BulletPartner& first = world.bulletWork.partners[pair.first];
    const BulletPartner& second = world.bulletWork.partners[pair.second];
    const double dt = first.flight.dt;
    const double from = std::max(first.pathFrom, second.pathFrom);
    pair.time = kNever;
    const bool bothFixed = first.tied && second.tied;
    if (bothFixed || !(from < dt)) { return; }
    const Sweep path = pathAfter(second, from);
    const Sweep otherPath = pathAfter(first, from);
    double limit = 1;
    for (const std::uint32_t own : world.bodies[second.flight.slot].shapes) {
        for (const std::uint32_t other : world.bodies[first.flight.slot].shapes) {
            const Shape& a = world.shapes[other];
            const Shape& b = world.shapes[own];
            if (a.def.sensor || b.def.sensor || !mayTouch(world, a, b) || !(limit > 0)) { continue; }
            FlightObstacle shapes{.own = own, .other = other};
            shapes.level = targetOf(world, shapes);
            shapes.lift = rideSag(world, shapes, std::max(first.impacts, second.impacts)) * toDouble(pair.carrier);
            const FirstImpact impact = firstImpactWith(world, path, otherPath, shapes, limit, scratch);
            if (!impact.hit) { continue; }
            limit = impact.fraction;
            pair.shapes = shapes;
            pair.time = from + impact.fraction * (dt - from);
        }
    }
}

void findPartners(WorldState& world, double dt, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    findCandidates(world, static_cast<Real>(dt));
    work.partners.clear();
    work.pairs.clear();
    for (const std::uint32_t slot : work.candidates) { work.partners.push_back(partnerOf(world, slot, dt, scratch)); }
    for (std::uint32_t i = 0; i < work.partners.size(); ++i) {
        for (std::uint32_t j = i + 1; j < work.partners.size(); ++j) {
            if (!work.partners[i].isBullet && !work.partners[j].isBullet) { continue; }
            work.pairs.push_back({.first = i, .second = j, .shapes = {}, .carrier = {}});
            predict(world, work.pairs.back(), scratch);
        }
    }
}

/// From the solver's hands, or from sleep, into flight: with the velocity that it has at this time.
void takeOff(WorldState& world, BulletPartner& partner, double time) {
    Flight& flight = partner.flight;
    const Body& body = flight.body();
    const double length = flight.dt - partner.pathFrom;
    const BodyMotion now = motionAt(partner.path, (time - partner.pathFrom) / length, body.localCenter);
    flight.motion = world.motions[flight.slot];
    flight.motion.center = now.center;
    flight.motion.angle = now.angle;
    flight.motion.pose = now.pose;
    if (body.awake && body.role == BodyRole::free) {  // its velocity is that of the end of the step
        flight.motion.velocity -= static_cast<Real>(flight.dt - time) * accelerationOf(world, body);
    }
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
    const double length = partner.flight.dt - partner.pathFrom;
    const BodyMotion now =
        motionAt(partner.path, (time - partner.pathFrom) / length, partner.flight.body().localCenter);
    partner.flight.motion.center = now.center;
    partner.flight.motion.angle = now.angle;
    partner.flight.motion.pose = now.pose;
}

void report(WorldState& world, const BulletPair& pair, const ContactConstraint& constraint, double time) {
    const Flight& second = world.bulletWork.partners[pair.second].flight;
    if (!(impactSpeed(constraint) > second.threshold())) { return; }
    second.scratch->events.push_back(
        hitOf(world, pair.shapes.other, pair.shapes.own, constraint, second.motion.center, time / second.dt));
}

/// Sets them back to their target along the normal, the lighter one farther; what is on its way by the solver stays on
/// it.
void setApart(WorldState& world, const BulletPair& pair, const Manifold& manifold, Vec2 normal) {
    BulletPartner& first = world.bulletWork.partners[pair.first];
    BulletPartner& second = world.bulletWork.partners[pair.second];
    const double target = targetOf(world, pair.shapes);
    const double gap = target - static_cast<double>(deepestSeparation(manifold));
    const double inverseFirst = first.flies ? static_cast<double>(first.flight.body().inverseMass) : 0;
    const double inverseSecond = second.flies ? static_cast<double>(second.flight.body().inverseMass) : 0;
    const double noise = toleranceOf(world, pair.shapes) + static_cast<double>(roundingOf(world, pair.shapes));
    if (!(gap > noise) || !(inverseFirst + inverseSecond > 0)) { return; }
    const DVec2 way = (gap / (inverseFirst + inverseSecond)) * toDouble(normal);
    shift(first.flight, -inverseFirst * way);
    shift(second.flight, inverseSecond * way);
}

void collideBodies(WorldState& world, BulletPair& pair, double time) {
    Flight& first = world.bulletWork.partners[pair.first].flight;
    Flight& second = world.bulletWork.partners[pair.second].flight;
    const Shape& own = world.shapes[pair.shapes.own];
    const Shape& other = world.shapes[pair.shapes.other];
    const Manifold manifold =
        obstacleManifold(world, pair.shapes, first.motion.pose, second.motion.pose, reachOf(world, pair.shapes));
    if (manifold.count == 0) { return; }
    ContactConstraint constraint = constraintOf(manifold, first.motion, first.body().localCenter, second.motion,
                                                mixedSurface(own.def, other.def), 0);
    constraint.slotA = kFirstSlot;
    constraint.slotB = kSecondSlot;
    FlightScratch& scratch = *second.scratch;
    scratch.states.assign(3, {});
    scratch.inertias.assign(3, {});
    for (const Flight* flight : {&first, &second}) {
        const BodySlot slot = flight == &first ? kFirstSlot : kSecondSlot;
        scratch.states[slot].velocity = flight->motion.velocity;
        scratch.states[slot].angularVelocity = flight->motion.angularVelocity;
        scratch.inertias[slot] = {flight->body().inverseMass, flight->body().inverseInertia};
    }
    prepareContact(constraint, scratch.inertias);
    ContactConstraint* const only[] = {&constraint};
    const ImpactRule rule{.restitutionThreshold = second.threshold(), .resolvePlastic = true};
    resolveImpacts(only, {scratch.states, scratch.inertias}, rule, kPairRounds);
    for (Flight* flight : {&first, &second}) {
        const BodySlot slot = flight == &first ? kFirstSlot : kSecondSlot;
        flight->motion.velocity = scratch.states[slot].velocity;
        flight->motion.angularVelocity = scratch.states[slot].angularVelocity;
    }
    report(world, pair, constraint, time);
    setApart(world, pair, manifold, constraint.normal);
    const bool bounces = constraint.restitution > 0 && impactSpeed(constraint) > second.threshold();
    pair.carrier = bounces ? Vec2{} : constraint.normal;
}

/// It rides on with the other one to the end of the step: what it would have done on its own is lost.
void ride(BulletPartner& rider, const BulletPartner& carrier, double time) {
    enterLedger(rider.flight, LostTimeReason::clamp);
    rider.path = pathWith(rider, carrier, time);
    rider.pathFrom = time;
    rider.nextImpact = kNever;
    rider.flies = false;
    rider.tied = true;
}

/// Whatever happens next to one whose motion changed.
void goOn(WorldState& world, std::uint32_t index, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    BulletPartner& partner = work.partners[index];
    if (partner.flies) { lookAhead(partner); }
    for (BulletPair& pair : work.pairs) {
        if (pair.first == index || pair.second == index) { predict(world, pair, scratch); }
    }
}

bool isExhausted(BulletPartner& partner) {
    return isExhausted(partner.flight, partner.impacts++, LostTimeReason::budget);
}

/// It stays where it is.
void stop(BulletPartner& partner, double time, LostTimeReason reason) {
    const Flight& flight = partner.flight;
    enterLedger(flight, reason);
    partner.path = {.localCenter = toDouble(flight.body().localCenter),
                    .c0 = flight.motion.center,
                    .c1 = flight.motion.center,
                    .a0 = flight.motion.angle,
                    .a1 = flight.motion.angle};
    partner.pathFrom = time;
    partner.nextImpact = kNever;
    partner.flies = false;
    partner.tied = true;
}

void meet(WorldState& world, BulletPair& pair, FlightScratch& scratch) {
    BulletPartner& first = world.bulletWork.partners[pair.first];
    BulletPartner& second = world.bulletWork.partners[pair.second];
    const double time = pair.time;
    bringTo(world, first, time);
    bringTo(world, second, time);
    collideBodies(world, pair, time);
    ++scratch.impacts;
    const BulletPair met = pair;
    for (const std::uint32_t index : {met.first, met.second}) {
        BulletPartner& partner = world.bulletWork.partners[index];
        const BulletPartner& other = world.bulletWork.partners[index == met.first ? met.second : met.first];
        partner.moved = true;
        if (!partner.flies) { continue; }
        notePose(partner.flight);
        resolveStanding(partner.flight);
        // What is tied does not get out of the way in this step.
        if (!other.flies && other.tied && partner.impacts > 1) {
            ride(partner, other, time);
        } else if (isExhausted(partner)) {
            stop(partner, time, LostTimeReason::budget);
        }
    }
    goOn(world, met.first, scratch);
    goOn(world, met.second, scratch);
}

void bounce(WorldState& world, std::uint32_t index, FlightScratch& scratch) {
    BulletPartner& partner = world.bulletWork.partners[index];
    bringTo(world, partner, partner.nextImpact);
    if (isExhausted(partner)) {
        stop(partner, partner.flight.elapsed, LostTimeReason::budget);
    } else {
        const bool isHit = resolveStanding(partner.flight);
        notePose(partner.flight);
        ++scratch.impacts;
        if (isHit && partner.flight.stops) { stop(partner, partner.flight.elapsed, LostTimeReason::stop); }
    }
    goOn(world, index, scratch);
}

void store(WorldState& world, BulletPartner& partner, Real dt) {
    const std::uint32_t slot = partner.flight.slot;
    BodyMotion& motion = world.motions[slot];
    if (!partner.moved) { return; }
    // What sleeps has begun no step lately: where it stands is where this one began.
    const std::size_t before = world.awake.size();
    wake(world, slot);
    resetBodies(world, std::span(world.awake).subspan(before), dt);
    if (partner.flies) {
        if (partner.flight.remaining() > 0) { advance(partner.flight, partner.path, 1); }
        limitSpeed(partner.flight);
        motion = partner.flight.motion;
        return;
    }
    motion = motionAt(partner.path, 1, partner.flight.body().localCenter);
    motion.velocity = partner.flight.motion.velocity;
    motion.angularVelocity = partner.flight.motion.angularVelocity;
}

}  // namespace

void flyBullets(WorldState& world, double dt, FlightScratch& scratch) {
    BulletWork& work = world.bulletWork;
    findPartners(world, dt, scratch);
    while (true) {
        const auto pair = std::min_element(work.pairs.begin(), work.pairs.end(),
                                           [](const BulletPair& a, const BulletPair& b) { return a.time < b.time; });
        const auto alone = std::min_element(
            work.partners.begin(), work.partners.end(),
            [](const BulletPartner& a, const BulletPartner& b) { return a.nextImpact < b.nextImpact; });
        const double pairTime = pair != work.pairs.end() ? pair->time : kNever;
        const double aloneTime = alone != work.partners.end() ? alone->nextImpact : kNever;
        if (!(std::min(pairTime, aloneTime) < kNever)) { break; }
        if (pairTime < aloneTime) {
            meet(world, *pair, scratch);
        } else {
            bounce(world, static_cast<std::uint32_t>(alone - work.partners.begin()), scratch);
        }
    }
    for (BulletPartner& partner : work.partners) { store(world, partner, static_cast<Real>(dt)); }
    world.counters.sweeps += work.partners.size();
    std::erase_if(world.flyers, [&](std::uint32_t slot) {
        return std::binary_search(work.candidates.begin(), work.candidates.end(), slot);
    });
}

}  // namespace swept::inline SWEPT_PRECISION
