#include "sweep_obstacles.h"

#include <algorithm>

#include "../../toi/toi_polygon.h"
#include "../bodies/travel.h"
#include "../contacts/ghosts.h"
#include "../contacts/may_touch.h"
#include "../contacts/shape_manifold.h"
#include "../state/tolerances.h"
#include "chain_crossing.h"
#include "ground_on_the_way.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isObstacle(const WorldState& world, const Shape& own, const Shape& other) {
    return !world.bodies[other.body].isDynamic() && !other.def.sensor && mayTouch(world, own, other);
}

/// What is sunk in deeper than the slack, and therefore swept however slow it is, may stir up to so many slacks: what
/// is pressed comes to rest somewhere there.
constexpr double kMostSlacks = 2;

ToiSettings settingsFor(const WorldState& world, const FlightObstacle& obstacle, double tMax) {
    return {.target = obstacle.level, .tolerance = toleranceOf(world, obstacle), .tMax = tMax};
}

/// Of an obstacle, along its sweep, and what sweeps towards it.
Toi countedToi(const ToiPolygon& other, const Sweep& otherSweep, const ToiPolygon& own, const Sweep& sweep,
               const ToiSettings& settings, FlightScratch& scratch) {
    const Toi toi = timeOfImpact(other, otherSweep, own, sweep, settings);
    ++scratch.counters.toiCalls;
    scratch.counters.toiIterations += static_cast<std::uint64_t>(toi.iterations);
    return toi;
}

/// Whether a rounded shape whose radius is sunk is lifted out and held as if its core were: what is pressed slowly, or
/// pulled by joints, gets deeper step by step. What is fast mostly comes out again.
bool isPressed(const WorldState& world, const FlightObstacle& obstacle) {
    const Body& body = world.bodies[world.shapes[obstacle.own].body];
    return !body.fast || body.holdingJoints > 0;
}

/// One obstacle: time of impact at its level, or at a lower one where it is within its level already.
Toi impactWith(const WorldState& world, const Sweep& sweep, const Sweep& otherSweep, FlightObstacle& obstacle,
               double tMax, FlightScratch& scratch, bool ignoresSunk) {
    const ToiPolygon own = asToiPolygon(world.shapes[obstacle.own].polygon);
    const ToiPolygon other = asToiPolygon(world.shapes[obstacle.other].polygon);
    Sweep lifted = sweep;
    lifted.c0 += obstacle.lift;
    lifted.c1 += obstacle.lift;
    Toi toi = countedToi(other, otherSweep, own, lifted, settingsFor(world, obstacle, tMax), scratch);
    if (toi.state == ToiState::hit && toi.fraction <= 0) {
        const bool isDeep = toi.separation < length(obstacle.lift) - slackOf(world, obstacle);
        if (isDeep && !ignoresSunk && !obstacle.isSunkInto) {
            if (isPressed(world, obstacle)) {
                toi.state = ToiState::overlapped;  // if of a rounded shape its radius alone is sunk
                return toi;
            }
            // What is fast and began the step so deep in ground may be pressed, too, and is held at this depth.
            const bool isGround = !world.bodies[world.shapes[obstacle.other].body].isDynamic();
            obstacle.isSunkInto = isGround && world.bodies[world.shapes[obstacle.own].body].sunk;
        }
        obstacle.level = std::min(obstacle.level, levelInContact(world, obstacle, toi.separation));
        toi = countedToi(other, otherSweep, own, lifted, settingsFor(world, obstacle, tMax), scratch);
    }
    return toi;
}

/// Manifold of an obstacle at the start of a sweep; `normal` in world coordinates.
struct StartContact {
    bool touches = false;
    Real deepest = 0;
    Vec2 normal{};
};

WorldTransform startOf(const Sweep& sweep) { return motionAt(sweep, 0, toReal(sweep.localCenter)).pose; }

StartContact startContact(const Manifold& manifold, const WorldTransform& otherPose, Real margin) {
    StartContact contact{manifold.count > 0, margin, rotate(otherPose.rotation, manifold.normal)};
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        contact.deepest = std::min(contact.deepest, manifold.points[i].separation);
    }
    return contact;
}

/// A chain refuses what belongs to a neighbour; for a sweep it still stands in the way, with its own side: what is half
/// way through the ground beside an inner vertex is shorter out along the ground, but goes out as its neighbours say.
/// @param known  returned unless the shapes overlap deeper than that
StartContact closestAtStart(const Shape& own, const Shape& segment, const WorldTransform& pose,
                            const WorldTransform& otherPose, Real margin, const StartContact& known) {
    const Manifold closest = collide(segment.polygon, own.polygon, relativeTransform(otherPose, pose), margin);
    StartContact contact = startContact(closest, otherPose, margin);
    if (!contact.touches || !(contact.deepest < known.deepest)) { return known; }
    const Vec2 normal = outwardNormal(segment.segment, closest.normal);
    if (normal == closest.normal) { return contact; }
    contact.normal = rotate(otherPose.rotation, normal);
    if (contact.deepest < 0) {  // else it is beside the segment, and may be below its line
        contact.deepest = separationAlong(segment.polygon, otherPose, own.polygon, pose, contact.normal);
    }
    return contact;
}

StartContact contactAtStart(const WorldState& world, const FlightObstacle& obstacle, const WorldTransform& pose,
                            const WorldTransform& otherPose, Real margin) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const Manifold manifold = obstacleManifold(world, obstacle, otherPose, pose, margin);
    const StartContact contact = startContact(manifold, otherPose, margin);
    if (contact.touches || !other.isChainSegment) { return contact; }
    return closestAtStart(own, other, pose, otherPose, margin, contact);
}

/// Likewise, of what overlaps: beside an inner vertex the points over a segment may be those of another side of a shape
/// that is round, and tell nothing of what is in it.
StartContact overlapAtStart(const WorldState& world, const FlightObstacle& obstacle, const WorldTransform& pose,
                            const WorldTransform& otherPose) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const Real margin = extentOfPair(own, other);
    const StartContact contact =
        startContact(obstacleManifold(world, obstacle, otherPose, pose, margin), otherPose, margin);
    return other.isChainSegment ? closestAtStart(own, other, pose, otherPose, margin, contact) : contact;
}

/// Ground flush with what the body stands on, along any of these normals: it may sink into it along the same normal, or
/// the side of the next piece would stop it.
/// @param slops  how far
/// @param from  seconds of the step at which the sweep begins
/// @param ofBody  slot: shapes of others are left out; `kNoIndex`: none is
void liftFlush(const WorldState& world, double slops, std::span<const Vec2> normals, double from,
               FlightScratch& scratch, std::uint32_t ofBody = kNoIndex) {
    for (FlightObstacle& obstacle : scratch.obstacles) {
        if (obstacle.isClear || obstacle.isBehind) { continue; }  // nobody sweeps against it, or is in its front
        const Shape& other = world.shapes[obstacle.other];
        if (ofBody != kNoIndex && other.body != ofBody) { continue; }
        const Real slop = slopOf(world, obstacle);
        const WorldTransform pose = groundPose(world, other.body, from);
        for (const Vec2 normal : normals) {
            const Real clear =
                separationAlong(other.polygon, pose, world.shapes[obstacle.own].polygon, scratch.startPose, normal);
            if (clear < -slop) { continue; }
            obstacle.lift = slops * static_cast<double>(slop) * toDouble(normal);
            break;
        }
    }
}

/// Overlap at the start is measured along the contact's normal: the sweep is looked at as if it began at the target.
void liftOut(const WorldState& world, FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep) {
    const StartContact contact = overlapAtStart(world, obstacle, startOf(sweep), startOf(otherSweep));
    const double depth = -static_cast<double>(std::min(contact.deepest, Real(0)));
    const double slack = slackOf(world, obstacle);
    obstacle.isSunkInto = depth > slack;
    const double allowed = obstacle.isSunkInto ? std::max(depth, kMostSlacks * slack)
                                               : depth + static_cast<double>(roundingOf(world, obstacle));
    obstacle.level = targetOf(world, obstacle);
    obstacle.lift = (obstacle.level + allowed) * toDouble(contact.normal);
}

/// How far the box of an obstacle is from a place, squared.
double squaredDistanceTo(const WorldState& world, const FlightObstacle& obstacle, DVec2 place) {
    const Aabb& box = world.broadphase->box(world.shapes[obstacle.other].proxy);
    const DVec2 lower = toDouble(box.lower);
    const DVec2 upper = toDouble(box.upper);
    const DVec2 away = DVec2{std::clamp(place.x, lower.x, upper.x), std::clamp(place.y, lower.y, upper.y)} - place;
    return dot(away, away);
}

/// What is near is looked at first: once an impact is known, what is farther is only followed so far.
void sortByDistance(const WorldState& world, const Sweep& sweep, FlightScratch& scratch) {
    scratch.nearest.clear();
    for (std::uint32_t i = 0; i < scratch.obstacles.size(); ++i) {
        scratch.nearest.push_back({squaredDistanceTo(world, scratch.obstacles[i], sweep.c0), i});
    }
    std::sort(scratch.nearest.begin(), scratch.nearest.end());
}

/// At least as far as the centre gets from where it begins: by a fraction of the sweep, by that part of it.
double longestWay(const Sweep& sweep) { return length(sweep.c1 - sweep.c0) + length(sweep.k); }

/// Static ground, which stays where its box is. @param way  that the centre goes at most, metres
bool isOutOfReach(const WorldState& world, const FlightObstacle& obstacle, const NearObstacle& near, double way) {
    const Shape& own = world.shapes[obstacle.own];
    const double reach = way + length(obstacle.lift) + static_cast<double>(own.radius + 2 * kTargetRatio * own.extent);
    if (!(near.distanceSquared > reach * reach)) { return false; }
    return world.bodies[world.shapes[obstacle.other].body].def.type == BodyType::fixed;
}

/// Of what is behind a chain as the sweep begins: it may be in it already, and is not lifted out of it.
FirstImpact firstTouch(const WorldState& world, const Sweep& sweep, const Sweep& otherSweep,
                       const FlightObstacle& obstacle, double limit, FlightScratch& scratch) {
    const Toi toi = countedToi(asToiPolygon(world.shapes[obstacle.other].polygon), otherSweep,
                               asToiPolygon(world.shapes[obstacle.own].polygon), sweep,
                               settingsFor(world, obstacle, limit), scratch);
    return {.hit = toi.state != ToiState::separated, .fraction = toi.fraction};
}

FirstImpact firstOfAll(const WorldState& world, const Sweep& sweep, double from, double to, FlightScratch& scratch,
                       double limit, bool ignoresSunk) {
    FirstImpact first{.fraction = limit};
    const double longest = longestWay(sweep);
    for (const NearObstacle& near : scratch.nearest) {
        if (!(first.fraction > 0)) { break; }
        FlightObstacle& obstacle = scratch.obstacles[near.index];
        if (obstacle.isClear || isOutOfReach(world, obstacle, near, first.fraction * longest)) { continue; }
        const Sweep otherSweep = obstacleSweep(world, world.shapes[obstacle.other].body, from, to);
        const FirstImpact impact =
            obstacle.isBehind
                ? firstTouch(world, sweep, otherSweep, obstacle, first.fraction, scratch)
                : firstImpactWith(world, sweep, otherSweep, obstacle, first.fraction, scratch, ignoresSunk);
        if (!impact.hit || passesFromBehind(world, obstacle, sweep, otherSweep, impact.fraction, scratch)) { continue; }
        first = {true, impact.fraction, near.index};
    }
    return first;
}

}  // namespace

BodyMotion motionAt(const Sweep& sweep, double fraction, Vec2 localCenter) {
    BodyMotion motion;
    motion.center = centerAt(sweep, fraction);
    motion.angle = angleAt(sweep, fraction);
    motion.pose = poseOf(motion.center, motion.angle, localCenter);
    return motion;
}

Sweep obstacleSweep(const WorldState& world, std::uint32_t body, double from, double to) {
    const BodyMotion& motion = world.motions[body];
    const DVec2 velocity = toDouble(motion.velocity);
    const auto spin = static_cast<double>(motion.angularVelocity);
    return {.localCenter = toDouble(world.bodies[body].localCenter),
            .c0 = motion.center + from * velocity,
            .c1 = motion.center + to * velocity,
            .a0 = motion.angle + from * spin,
            .a1 = motion.angle + to * spin};
}

WorldTransform groundPose(const WorldState& world, std::uint32_t body, double seconds) {
    const bool isThere = seconds == 0 || world.bodies[body].def.type == BodyType::fixed;
    if (isThere) { return world.motions[body].pose; }
    return motionAt(obstacleSweep(world, body, seconds, seconds), 0, world.bodies[body].localCenter).pose;
}

Aabb boxOfPath(const Shape& own, const Sweep& sweep) {
    return boxOfPath(sweep, static_cast<double>(own.radius + kTargetRatio * own.extent));
}

Aabb boxOfPath(const Sweep& sweep, double reach) {
    const DVec2 control = sweep.c0 + 0.5 * ((sweep.c1 - sweep.c0) - sweep.k);
    // Two by two, without a branch: nobody can predict which way a body flies.
    const DVec2 lower{std::min(std::min(sweep.c0.x, sweep.c1.x), control.x),
                      std::min(std::min(sweep.c0.y, sweep.c1.y), control.y)};
    const DVec2 upper{std::max(std::max(sweep.c0.x, sweep.c1.x), control.x),
                      std::max(std::max(sweep.c0.y, sweep.c1.y), control.y)};
    return roundedOutward({lower.x - reach, lower.y - reach}, {upper.x + reach, upper.y + reach});
}

void findObstacles(const WorldState& world, std::uint32_t body, const Sweep& sweep, double from,
                   FlightScratch& scratch) {
    scratch.obstacles.clear();
    scratch.chains.fromBehind.clear();
    bool isPlaced = false;
    for (const std::uint32_t slot : world.bodies[body].shapes) {
        const Shape& own = world.shapes[slot];
        if (own.def.sensor) { continue; }
        scratch.found.clear();
        world.broadphase->queryGround(boxOfPath(own, sweep), [&](ProxyId id) {
            scratch.found.push_back(world.proxyShapes[static_cast<std::uint32_t>(id)]);
            return true;
        });
        if (scratch.found.empty()) { continue; }
        std::sort(scratch.found.begin(), scratch.found.end());
        if (!isPlaced) { scratch.startPose = poseOf(sweep.c0, sweep.a0, world.bodies[body].localCenter); }
        isPlaced = true;
        StartAtChains start(world, slot, scratch.startPose, from);
        for (const std::uint32_t found : scratch.found) {
            const Shape& other = world.shapes[found];
            if (!isObstacle(world, own, other)) { continue; }
            if (scratch.ground != nullptr) { scratch.ground->meet(other.body); }
            FlightObstacle obstacle{.own = slot, .other = found};
            if (other.isChainSegment) {
                obstacle.isBehind = start.isBehind(found);
                if (!obstacle.isBehind && start.isCrossing(found, scratch)) {
                    scratch.chains.meetsBacks = true;
                    continue;
                }
            }
            obstacle.level = targetOf(world, obstacle);
            scratch.obstacles.push_back(obstacle);
        }
    }
}

Manifold obstacleManifold(const WorldState& world, const FlightObstacle& obstacle, const WorldTransform& other,
                          const WorldTransform& own, Real margin) {
    return shapeManifold(world, world.shapes[obstacle.other], world.shapes[obstacle.own], relativeTransform(other, own),
                         margin);
}

void allowSlack(const WorldState& world, const Sweep& sweep, double from, FlightScratch& scratch) {
    scratch.normals.clear();
    std::uint32_t otherBody = kNoIndex;
    WorldTransform otherPose;
    for (FlightObstacle& obstacle : scratch.obstacles) {
        const Shape& own = world.shapes[obstacle.own];
        const Shape& other = world.shapes[obstacle.other];
        const Real margin = contactReach(world, own) + contactReach(world, other);
        if (obstacle.isBehind || obstacle.height > margin + roundingOf(world, obstacle)) { continue; }
        // Of a path that is long, most is not where it begins. (The slop is more than was rounded.)
        const auto farthest = static_cast<double>(own.radius + margin + slopOf(own, other));
        if (squaredDistanceTo(world, obstacle, sweep.c0) > farthest * farthest) { continue; }
        if (other.body != otherBody) {  // of a chain, all are of one
            otherPose = startOf(obstacleSweep(world, other.body, from, from));
            otherBody = other.body;
        }
        const StartContact contact = contactAtStart(world, obstacle, scratch.startPose, otherPose, margin);
        if (!contact.touches) { continue; }
        obstacle.lift = slackOf(world, obstacle) * toDouble(contact.normal);
        if (contact.deepest <= kEndRatio * extentOfPair(own, other)) { scratch.normals.push_back(contact.normal); }
    }
    liftFlush(world, static_cast<double>(kSlackRatio / kTargetRatio), scratch.normals, from, scratch);
}

void allowSag(const WorldState& world, std::span<const Vec2> normals, double from, FlightScratch& scratch) {
    liftFlush(world, kSagSlops, normals, from, scratch);
}

void allowRide(const WorldState& world, const TurningRide& ride, double from, FlightScratch& scratch) {
    liftFlush(world, ride.sag, {&ride.normal, 1}, from, scratch, ride.body);
}

FirstImpact firstImpactWith(const WorldState& world, const Sweep& sweep, const Sweep& otherSweep,
                            FlightObstacle& obstacle, double limit, FlightScratch& scratch, bool ignoresSunk) {
    Toi toi = impactWith(world, sweep, otherSweep, obstacle, limit, scratch, ignoresSunk);
    if (toi.state == ToiState::overlapped) {
        liftOut(world, obstacle, sweep, otherSweep);
        if (ignoresSunk && obstacle.isSunkInto) {
            scratch.isSunk = true;
            return {};
        }
        toi = impactWith(world, sweep, otherSweep, obstacle, limit, scratch, ignoresSunk);
    }
    const bool blocked = toi.state == ToiState::overlapped || toi.state == ToiState::failed;
    return {.hit = toi.state == ToiState::hit || blocked, .fraction = toi.fraction};
}

FirstImpact firstImpact(const WorldState& world, const Sweep& sweep, double from, double to, FlightScratch& scratch,
                        double limit, bool ignoresSunk) {
    sortByDistance(world, sweep, scratch);
    for (;;) {
        const std::size_t crossed = scratch.chains.fromBehind.size();
        const FirstImpact first = firstOfAll(world, sweep, from, to, scratch, limit, ignoresSunk);
        // What is crossed next may be near before what is crossed first.
        if (!first.hit || scratch.chains.fromBehind.size() == crossed) { return first; }
        FlightObstacle& obstacle = scratch.obstacles[first.obstacle];
        const Sweep otherSweep = obstacleSweep(world, world.shapes[obstacle.other].body, from, to);
        if (!passesFromBehind(world, obstacle, sweep, otherSweep, first.fraction, scratch)) { return first; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
