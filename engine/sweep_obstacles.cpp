#include "sweep_obstacles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "ghosts.h"
#include "shape_manifold.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Box of all that is within `reach` of a position of the centre: hull of the control points of the path, a quadratic
/// Bézier curve.
Aabb boxAround(const Sweep& sweep, double reach) {
    const DVec2 control = sweep.c0 + 0.5 * ((sweep.c1 - sweep.c0) - sweep.k);
    // Two by two, without a branch: nobody can predict which way a body flies.
    const DVec2 lower{std::min(std::min(sweep.c0.x, sweep.c1.x), control.x),
                      std::min(std::min(sweep.c0.y, sweep.c1.y), control.y)};
    const DVec2 upper{std::max(std::max(sweep.c0.x, sweep.c1.x), control.x),
                      std::max(std::max(sweep.c0.y, sweep.c1.y), control.y)};
    return roundedOutward({lower.x - reach, lower.y - reach}, {upper.x + reach, upper.y + reach});
}

bool isObstacle(const WorldState& world, const Shape& own, const Shape& other) {
    return !world.bodies[other.body].isDynamic() && !other.def.sensor && mayTouch(world, own, other);
}

/// A chain lets through what is behind it: the centre of the shape's core decides, as in the manifold.
/// @param start  pose of the shape's body, once it is known: what is near a chain is near several pieces of it
bool isBehindChain(const WorldState& world, const Shape& own, const Shape& other, const Sweep& sweep,
                   std::optional<WorldTransform>& start) {
    if (!other.isChainSegment) { return false; }
    if (!start) { start = poseOf(sweep.c0, sweep.a0, toReal(sweep.localCenter)); }
    Vec2 middle;
    for (const Vec2 vertex : own.polygon.points()) { middle += vertex; }
    middle = (1 / static_cast<Real>(own.polygon.count)) * middle;
    const Vec2 local = applyInverse(world.motions[other.body].pose, apply(*start, middle));
    return dot(local - other.segment.p, normalOf(other.segment)) < 0;
}

ToiSettings settingsFor(const WorldState& world, const FlightObstacle& obstacle, double tMax) {
    return {.target = obstacle.level, .tolerance = toleranceOf(world, obstacle), .tMax = tMax};
}

/// One obstacle: time of impact at its level, or at a lower one where it is within its level already.
Toi impactWith(const WorldState& world, const Sweep& sweep, const Sweep& otherSweep, FlightObstacle& obstacle,
               double tMax, FlightScratch& scratch) {
    const ToiPolygon own = toiPolygonOf(world.shapes[obstacle.own].polygon);
    const ToiPolygon other = toiPolygonOf(world.shapes[obstacle.other].polygon);
    Sweep lifted = sweep;
    lifted.c0 += obstacle.lift;
    lifted.c1 += obstacle.lift;
    Toi toi = timeOfImpact(other, otherSweep, own, lifted, settingsFor(world, obstacle, tMax));
    ++scratch.toiCalls;
    scratch.toiIterations += static_cast<std::uint64_t>(toi.iterations);
    if (toi.state == ToiState::hit && toi.fraction <= 0) {
        obstacle.level = std::min(obstacle.level, levelInContact(world, obstacle, toi.separation));
        toi = timeOfImpact(other, otherSweep, own, lifted, settingsFor(world, obstacle, tMax));
        ++scratch.toiCalls;
        scratch.toiIterations += static_cast<std::uint64_t>(toi.iterations);
    }
    return toi;
}

/// Manifold of an obstacle at the start of a sweep; `normal` in world coordinates.
struct StartContact {
    bool touches = false;
    Real deepest = 0;
    Vec2 normal{};
};

/// A chain refuses what belongs to a neighbour; for a sweep it still stands in the way, with its own side.
StartContact contactAtStart(const WorldState& world, const FlightObstacle& obstacle, const Sweep& sweep,
                            const Sweep& otherSweep, Real margin) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const WorldTransform pose = motionAt(sweep, 0, toReal(sweep.localCenter)).pose;
    const WorldTransform otherPose = motionAt(otherSweep, 0, toReal(otherSweep.localCenter)).pose;
    Manifold manifold = obstacleManifold(world, obstacle, otherPose, pose, margin);
    if (manifold.count == 0 && other.isChainSegment) {
        manifold = collide(other.polygon, own.polygon, relativeTransform(otherPose, pose), margin);
        if (dot(manifold.normal, normalOf(other.segment)) < 0) { manifold.normal = normalOf(other.segment); }
    }
    StartContact contact{manifold.count > 0, margin, rotate(otherPose.rotation, manifold.normal)};
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        contact.deepest = std::min(contact.deepest, manifold.points[i].separation);
    }
    return contact;
}

/// How far a body may sink into what the solver holds it off, metres.
double slackOf(const WorldState& world, const FlightObstacle& obstacle) {
    return static_cast<double>(slopOf(world, obstacle) * (kSlackRatio / kTargetRatio));
}

/// Ground flush with what the body stands on, along any of these normals: it may sink into it along the same normal, or
/// the side of the next piece would stop it. @param slops  how far
void liftFlush(const WorldState& world, const Sweep& sweep, double slops, std::span<const Vec2> normals,
               FlightScratch& scratch) {
    const WorldTransform pose = motionAt(sweep, 0, toReal(sweep.localCenter)).pose;
    for (FlightObstacle& obstacle : scratch.obstacles) {
        const Shape& other = world.shapes[obstacle.other];
        const Real slop = slopOf(world, obstacle);
        for (const Vec2 normal : normals) {
            const Real clear = separationAlong(other.polygon, world.motions[other.body].pose,
                                               world.shapes[obstacle.own].polygon, pose, normal);
            if (clear < -slop) { continue; }
            obstacle.lift = slops * static_cast<double>(slop) * toDouble(normal);
            break;
        }
    }
}

/// Overlap at the start is measured along the contact's normal: the sweep is looked at as if it began at the target.
DVec2 liftOf(const WorldState& world, const FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep) {
    const Real margin = std::min(world.shapes[obstacle.own].extent, world.shapes[obstacle.other].extent);
    const StartContact contact = contactAtStart(world, obstacle, sweep, otherSweep, margin);
    const double up = targetOf(world, obstacle) +
                      static_cast<double>(roundingOf(world, obstacle) - std::min(contact.deepest, Real(0)));
    return up * toDouble(contact.normal);
}

/// Normal, in the frame of its body, of the face of the obstacle that a place is farthest above; of a chain, of its
/// side. 0: there are no faces.
Vec2 faceTowards(const WorldState& world, const Shape& other, DVec2 place) {
    if (other.isChainSegment) { return other.polygon.normals[0]; }
    const Vec2 local = applyInverse(world.motions[other.body].pose, place);
    Vec2 best{};
    Real highest = -std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; other.polygon.count > 1 && i < static_cast<std::size_t>(other.polygon.count); ++i) {
        const Real above = dot(other.polygon.normals[i], local - other.polygon.vertices[i]);
        if (above > highest) {
            highest = above;
            best = other.polygon.normals[i];
        }
    }
    return best;
}

/// A straight path that the solver moved a body on, and its poses at both ends.
struct SolvedPath {
    Sweep sweep;
    WorldTransform start;
    WorldTransform end;
    double time = 0;  ///< s
};

/// How far, at most, a point of the shape gets from the straight line between its two places in the frame of the
/// obstacle, metres: an eighth of its largest acceleration there in the unit of the path's time. Its own turn about its
/// centre, the turn of the obstacle about its own (Coriolis, centrifugal).
double bulgeOf(const Shape& own, const Sweep& path, const Sweep& ground) {
    const auto arm = static_cast<double>(own.radius - own.polygon.radius);
    const double turn = std::fabs(path.a1 - path.a0);
    const double groundTurn = std::fabs(ground.a1 - ground.a0);
    const double way = length((path.c1 - path.c0) - (ground.c1 - ground.c0));
    const double farthest = length(path.c0 - ground.c0) + way + static_cast<double>(own.radius);
    return (arm * turn * turn + 2 * groundTurn * (way + arm * turn) + groundTurn * groundTurn * farthest) / 8;
}

/// Whether the body stays on the outer side of a face of the obstacle, sunk in no deeper than it may be: both ends of
/// the path tell, and how far it bulges between them.
bool staysOutside(const WorldState& world, const SolvedPath& path, const FlightObstacle& obstacle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const Vec2 face = faceTowards(world, other, path.sweep.c0);
    if (face == Vec2{}) { return false; }
    const WorldTransform& ground = world.motions[other.body].pose;
    const Sweep groundSweep = obstacleSweep(world, other.body, 0, path.time);
    const bool moves = world.bodies[other.body].def.type != BodyType::fixed;
    const WorldTransform groundEnd =
        moves ? motionAt(groundSweep, 1, world.bodies[other.body].localCenter).pose : ground;
    const Real first = separationAlong(other.polygon, ground, own.polygon, path.start, rotate(ground.rotation, face));
    const Real last =
        separationAlong(other.polygon, groundEnd, own.polygon, path.end, rotate(groundEnd.rotation, face));
    const double least = static_cast<double>(std::min(first, last) - roundingOf(world, obstacle)) -
                         bulgeOf(own, path.sweep, groundSweep);
    const bool isHeld = first <= contactReach(world, own) + contactReach(world, other);
    const double slack = isHeld ? slackOf(world, obstacle) : 0;
    return least >= targetOf(world, obstacle) + toleranceOf(world, obstacle) - slack;
}

/// What is near is looked at first: once an impact is known, what is farther is only followed so far.
void sortByDistance(const WorldState& world, const Sweep& sweep, FlightScratch& scratch) {
    scratch.nearest.clear();
    for (std::uint32_t i = 0; i < scratch.obstacles.size(); ++i) {
        const Aabb& box = world.broadphase->box(world.shapes[scratch.obstacles[i].other].proxy);
        const DVec2 lower = toDouble(box.lower);
        const DVec2 upper = toDouble(box.upper);
        const DVec2 closest{std::clamp(sweep.c0.x, lower.x, upper.x), std::clamp(sweep.c0.y, lower.y, upper.y)};
        const DVec2 away = closest - sweep.c0;
        scratch.nearest.push_back({dot(away, away), i});
    }
    std::sort(scratch.nearest.begin(), scratch.nearest.end());
}

}  // namespace

ToiPolygon toiPolygonOf(const Polygon& polygon) {
    ToiPolygon result;
    result.count = polygon.count;
    result.radius = static_cast<double>(polygon.radius);
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        result.vertices[i] = toDouble(polygon.vertices[i]);
    }
    return result;
}

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

double targetOf(const WorldState& world, const FlightObstacle& obstacle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const auto extent = static_cast<double>(std::min(own.extent, other.extent));
    const double unit = std::max(static_cast<double>(kFlightRoundings) * std::numeric_limits<double>::epsilon(),
                                 static_cast<double>(kEpsilon));
    return std::clamp(unit * static_cast<double>(own.size + other.size),
                      static_cast<double>(kFlightTargetRatio) * extent, static_cast<double>(kTargetRatio) * extent);
}

Real roundingOf(const WorldState& world, const FlightObstacle& obstacle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    return std::min(kFlightRoundings * kEpsilon * (own.size + other.size), slopOf(world, obstacle));
}

Real reachOf(const WorldState& world, const FlightObstacle& obstacle) {
    const double met = targetOf(world, obstacle) + 3 * toleranceOf(world, obstacle);
    return static_cast<Real>(met) + roundingOf(world, obstacle);
}

double levelInContact(const WorldState& world, const FlightObstacle& obstacle, double separation) {
    // What rounding, or a corner that turns in, leaves of an approach that was dealt with must not count as an impact
    // again and again: bars that come to rest on uneven ground lost 1.7 % of their time by it.
    const Real sink = std::max(roundingOf(world, obstacle), kChatterSlops * slopOf(world, obstacle));
    return separation - 2 * toleranceOf(world, obstacle) - static_cast<double>(sink);
}

double toleranceOf(const WorldState& world, const FlightObstacle& obstacle) {
    const double target = targetOf(world, obstacle);
    const auto wanted = static_cast<double>(world.settings.toiTolerance);
    return wanted > 0 ? std::min(wanted, target / 2) : target / 4;
}

Real slopOf(const WorldState& world, const FlightObstacle& obstacle) {
    return kTargetRatio * std::min(world.shapes[obstacle.own].extent, world.shapes[obstacle.other].extent);
}

double rideSag(const WorldState& world, const FlightObstacle& obstacle, int impacts) {
    const auto slop = static_cast<double>(slopOf(world, obstacle));
    return slop * std::min(std::ldexp(kSagSlops, impacts / kImpactsPerDoubling), kMostSagSlops);
}

Aabb boxOfPath(const Shape& own, const Sweep& sweep) {
    return boxAround(sweep, static_cast<double>(own.radius + kTargetRatio * own.extent));
}

void findObstacles(const WorldState& world, std::uint32_t body, const Sweep& sweep, FlightScratch& scratch) {
    scratch.obstacles.clear();
    std::optional<WorldTransform> start;
    for (const std::uint32_t slot : world.bodies[body].shapes) {
        const Shape& own = world.shapes[slot];
        if (own.def.sensor) { continue; }
        scratch.found.clear();
        world.broadphase->queryGround(boxOfPath(own, sweep), [&](ProxyId id) {
            scratch.found.push_back(world.proxyShapes[static_cast<std::uint32_t>(id)]);
            return true;
        });
        std::sort(scratch.found.begin(), scratch.found.end());
        for (const std::uint32_t found : scratch.found) {
            const Shape& other = world.shapes[found];
            if (!isObstacle(world, own, other) || isBehindChain(world, own, other, sweep, start)) { continue; }
            FlightObstacle obstacle{.own = slot, .other = found};
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

void allowSlack(const WorldState& world, const Sweep& sweep, double dt, FlightScratch& scratch) {
    scratch.normals.clear();
    for (FlightObstacle& obstacle : scratch.obstacles) {
        const Shape& own = world.shapes[obstacle.own];
        const Shape& other = world.shapes[obstacle.other];
        const Sweep otherSweep = obstacleSweep(world, other.body, 0, dt);
        const Real margin = contactReach(world, own) + contactReach(world, other);
        const StartContact contact = contactAtStart(world, obstacle, sweep, otherSweep, margin);
        if (!contact.touches) { continue; }
        obstacle.lift = slackOf(world, obstacle) * toDouble(contact.normal);
        if (contact.deepest <= kEndRatio * std::min(own.extent, other.extent)) {
            scratch.normals.push_back(contact.normal);
        }
    }
    liftFlush(world, sweep, static_cast<double>(kSlackRatio / kTargetRatio), scratch.normals, scratch);
}

void allowSag(const WorldState& world, const Sweep& sweep, std::span<const Vec2> normals, FlightScratch& scratch) {
    liftFlush(world, sweep, kSagSlops, normals, scratch);
}

FirstImpact firstImpactWith(const WorldState& world, const Sweep& sweep, const Sweep& otherSweep,
                            FlightObstacle& obstacle, double limit, FlightScratch& scratch) {
    Toi toi = impactWith(world, sweep, otherSweep, obstacle, limit, scratch);
    if (toi.state == ToiState::overlapped) {
        obstacle.lift = liftOf(world, obstacle, sweep, otherSweep);
        obstacle.level = targetOf(world, obstacle);
        toi = impactWith(world, sweep, otherSweep, obstacle, limit, scratch);
    }
    const bool blocked = toi.state == ToiState::overlapped || toi.state == ToiState::failed;
    return {.hit = toi.state == ToiState::hit || blocked, .fraction = toi.fraction};
}

FirstImpact firstImpact(const WorldState& world, const Sweep& sweep, double from, double to, FlightScratch& scratch,
                        double limit) {
    FirstImpact first{.fraction = limit};
    sortByDistance(world, sweep, scratch);
    for (const NearObstacle& near : scratch.nearest) {
        if (!(first.fraction > 0)) { break; }
        FlightObstacle& obstacle = scratch.obstacles[near.index];
        if (obstacle.isClear) { continue; }
        const Sweep otherSweep = obstacleSweep(world, world.shapes[obstacle.other].body, from, to);
        const FirstImpact impact = firstImpactWith(world, sweep, otherSweep, obstacle, first.fraction, scratch);
        if (impact.hit) { first = impact; }
    }
    return first;
}

Sweep pathOf(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    return {.localCenter = toDouble(body.localCenter),
            .c0 = body.startCenter,
            .c1 = motion.center,
            .a0 = body.startAngle,
            .a1 = motion.angle};
}

bool movedFast(const WorldState& world, std::uint32_t slot, double share) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const auto extent = static_cast<double>(body.extent);
    const double turned = std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    const double slow = share * static_cast<double>(kFastRatio) * extent;
    return extent > 0 && length(motion.center - body.startCenter) + turned > slow;
}

FirstImpact impactOfPath(const WorldState& world, std::uint32_t slot, double time, double limit,
                         FlightScratch& scratch) {
    const Sweep path = pathOf(world, slot);
    findObstacles(world, slot, path, scratch);
    if (scratch.obstacles.empty()) { return {}; }
    // Most of what is fast slides along something, or leaves it: that takes no search.
    const SolvedPath solved{path, poseOf(path.c0, path.a0, world.bodies[slot].localCenter), world.motions[slot].pose,
                            time};
    bool areClear = true;
    for (FlightObstacle& obstacle : scratch.obstacles) {
        obstacle.isClear = staysOutside(world, solved, obstacle);
        areClear = areClear && obstacle.isClear;
    }
    if (areClear) { return {}; }
    allowSlack(world, path, time, scratch);
    return firstImpact(world, path, 0, time, scratch, limit);
}

}  // namespace swept::inline SWEPT_PRECISION
