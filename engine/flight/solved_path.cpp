#include "solved_path.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../toi/toi_polygon.h"
#include "../bodies/body_mass.h"
#include "../bodies/travel.h"
#include "../contacts/chain_passage.h"
#include "../state/tolerances.h"
#include "chain_crossing.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The face of the obstacle that a place is farthest above; of a chain, its side. −1: there are no faces.
int faceTowards(const WorldState& world, const Shape& other, DVec2 place) {
    if (other.isChainSegment) { return 0; }
    const Vec2 local = applyInverse(world.motions[other.body].pose, place);
    int best = -1;
    Real highest = -std::numeric_limits<Real>::infinity();
    for (int i = 0; other.polygon.count > 1 && i < other.polygon.count; ++i) {
        const auto face = static_cast<std::size_t>(i);
        const Real above = dot(other.polygon.normals[face], local - other.polygon.vertices[face]);
        if (above > highest) {
            highest = above;
            best = i;
        }
    }
    return best;
}

/// A straight path that the solver moved a body on, and its poses at both ends.
struct SolvedPath {
    Sweep sweep;
    WorldTransform start;
    WorldTransform end;
    double time = 0;                   ///< s
    std::uint32_t reacher = kNoIndex;  ///< whose reach is known
    Real reach = 0;

    /// `contactReach` of a shape of the body: it meets several obstacles.
    Real reachOf(const WorldState& world, std::uint32_t shape) {
        if (shape != reacher) { reach = contactReach(world, world.shapes[reacher = shape]); }
        return reach;
    }
};

/// How far, at most, a point of the shape gets from the straight line between its two places in the frame of the
/// obstacle, metres: an eighth of its largest acceleration there in the unit of the path's time. Its own turn about its
/// centre, the turn of the obstacle about its own (Coriolis, centrifugal).
double bulgeOf(const Shape& own, const Sweep& path, const Sweep& ground) {
    const auto arm = static_cast<double>(own.radius - own.polygon.radius);
    const double turn = std::fabs(path.a1 - path.a0);
    const double groundTurn = std::fabs(ground.a1 - ground.a0);
    if (groundTurn == 0) { return arm * turn * turn / 8; }
    const double way = length((path.c1 - path.c0) - (ground.c1 - ground.c0));
    const double farthest = length(path.c0 - ground.c0) + way + static_cast<double>(own.radius);
    return (arm * turn * turn + 2 * groundTurn * (way + arm * turn) + groundTurn * groundTurn * farthest) / 8;
}

/// A face of an obstacle, in the world.
struct GroundPlane {
    GroundPlane(const Polygon& ground, std::size_t face, const WorldTransform& pose)
        : normal(rotate(pose.rotation, ground.normals[face])),
          top(rotate(pose.rotation, ground.vertices[face])),
          position(pose.position),
          radius(ground.radius) {}

    /// How high above it a shape is, radii included, metres: never more than their distance, but for rounding.
    Real heightOf(const Polygon& own, const WorldTransform& pose) const {
        const Vec2 inOwn = unrotate(pose.rotation, normal);
        Real lowest = dot(inOwn, own.vertices[0]);
        for (std::size_t i = 1; i < static_cast<std::size_t>(own.count); ++i) {
            lowest = std::min(lowest, dot(inOwn, own.vertices[i]));
        }
        return dot(normal, toReal(pose.position - position) - top) + lowest - radius - own.radius;
    }

    Vec2 normal;
    Vec2 top;
    DVec2 position;
    Real radius;
};

/// How high above a face of the obstacle the body stays on its path, and at its start, metres: both ends tell, and how
/// far it bulges between them.
struct Clearance {
    Real atStart = 0;
    double least = 0;
};

Clearance clearanceOf(const WorldState& world, const SolvedPath& path, const Shape& own, const Shape& other,
                      std::size_t face) {
    const GroundPlane plane(other.polygon, face, world.motions[other.body].pose);
    const Real first = plane.heightOf(own.polygon, path.start);
    Sweep groundSweep;
    Real last = 0;
    if (world.bodies[other.body].def.type == BodyType::fixed) {
        last = plane.heightOf(own.polygon, path.end);
    } else {
        groundSweep = obstacleSweep(world, other.body, 0, path.time);
        const WorldTransform end = motionAt(groundSweep, 1, world.bodies[other.body].localCenter).pose;
        last = GroundPlane(other.polygon, face, end).heightOf(own.polygon, path.end);
    }
    return {first, static_cast<double>(std::min(first, last) - roundingOf(own, other)) -
                       bulgeOf(own, path.sweep, groundSweep)};
}

/// Notes whether the body stays on the outer side of a face of the obstacle, sunk in no deeper than it may be.
void judge(const WorldState& world, SolvedPath& path, FlightObstacle& obstacle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const int face = faceTowards(world, other, path.sweep.c0);
    if (face < 0) { return; }
    const Clearance clearance = clearanceOf(world, path, own, other, static_cast<std::size_t>(face));
    obstacle.height = clearance.atStart;
    const double asked = obstacle.level + toleranceOf(world, obstacle.level);  // its target: nothing was met so far
    obstacle.isClear = clearance.least >= asked;
    if (obstacle.isClear || clearance.least < asked - slackOf(own, other)) { return; }
    obstacle.isClear = clearance.atStart <= path.reachOf(world, obstacle.own) + contactReach(world, other);
}

/// Of what is behind a chain at the start of its path: whether it still is at its end. Nothing stops it then.
bool staysBehind(const WorldState& world, const SolvedPath& path, const FlightObstacle& obstacle) {
    const Shape& other = world.shapes[obstacle.other];
    if (world.bodies[other.body].def.type != BodyType::fixed) { return false; }
    const Vec2 middle = middleOf(world.shapes[obstacle.own].polygon);
    return isBehind(other, applyInverse(world.motions[other.body].pose, apply(path.end, middle)));
}

/// One wall after the other: in a corner there are two, and setting off from one may lead back into the other.
constexpr int kMostSlides = 3;

/// How much deeper than it may be, along the normal of the obstacle, a body ends that is sunk into it, metres. What
/// turns bulges on its way: it would get deeper there, unless it ends four times as much farther out, so that it leaves
/// at once. But it need not leave what it is sunk into for that.
double excessOf(const WorldState& world, const Sweep& path, const Sweep& ground, const FlightObstacle& obstacle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const double lifted = length(obstacle.lift);
    const double end = separationAlong(asToiPolygon(other.polygon), ground, asToiPolygon(own.polygon), path, 1,
                                       (1 / lifted) * obstacle.lift);
    const double bulge = std::min(4 * bulgeOf(own, path, ground), slackOf(own, other));
    return obstacle.level + 2 * toleranceOf(world, obstacle) - lifted + bulge - end;
}

/// What is sunk in, and turns with one end out of a wall and with the other one into it, does not press where it is
/// deep: no contact takes its turn, and it would hang there for ever, held in each step.
void stopTurn(const WorldState& world, BodyMotion& motion, const FlightObstacle& obstacle, DVec2 normal) {
    const BodyMotion& ground = world.motions[world.shapes[obstacle.other].body];
    const Vec2 velocityThere = ground.velocity + cross(ground.angularVelocity, toReal(motion.center - ground.center));
    if (motion.angularVelocity != 0) { motion.angularVelocity = ground.angularVelocity; }  // what turns at all
    const Vec2 outward = toReal(normal);
    motion.velocity -= std::min(dot(motion.velocity - velocityThere, outward), Real(0)) * outward;
}

/// Sets the end of the path off what the body is sunk into, along the normal, as far as it may be sunk. A turn that
/// would throw it out is left out.
/// @return whether that changed anything
bool setOff(WorldState& world, std::uint32_t slot, double time, const FlightObstacle& obstacle) {
    const double lifted = length(obstacle.lift);
    if (!obstacle.isSunkInto || !(lifted > 0)) { return false; }
    BodyMotion& motion = world.motions[slot];
    const DVec2 normal = (1 / lifted) * obstacle.lift;
    const Sweep ground = obstacleSweep(world, world.shapes[obstacle.other].body, 0, time);
    Sweep path = pathOf(world, slot);
    double excess = excessOf(world, path, ground, obstacle);
    if (!(excess > 0)) { return false; }
    const double outward = dot((path.c1 - path.c0) - (ground.c1 - ground.c0), normal);
    if (std::min(outward, 0.0) + excess > slackOf(world, obstacle)) {
        path.a1 = motion.angle = path.a0;
        excess = std::max(excessOf(world, path, ground, obstacle), 0.0);
        stopTurn(world, motion, obstacle, normal);
    }
    motion.center += excess * normal;
    updatePose(world, slot);
    return true;
}

}  // namespace

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
    const double turned = std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    const double slow = share * static_cast<double>(body.slowRatio() * body.extent);
    return body.extent > 0 && length(motion.center - body.startCenter) + turned > slow;
}

FirstImpact impactOfPath(const WorldState& world, std::uint32_t slot, double time, double limit, FlightScratch& scratch,
                         bool ignoresSunk) {
    const Sweep path = pathOf(world, slot);
    findObstacles(world, slot, path, 0, scratch);
    if (scratch.obstacles.empty()) { return {}; }
    // Most of what is fast slides along something, or leaves it: that takes no search.
    SolvedPath solved{path, scratch.startPose, world.motions[slot].pose, time};
    bool areClear = true;
    for (FlightObstacle& obstacle : scratch.obstacles) {
        if (obstacle.isBehind) {
            obstacle.isClear = staysBehind(world, solved, obstacle);
        } else {
            judge(world, solved, obstacle);
        }
        areClear = areClear && obstacle.isClear;
    }
    if (areClear) { return {}; }
    allowSlack(world, path, 0, scratch);
    return firstImpact(world, path, 0, time, scratch, limit, ignoresSunk);
}

void noteCrossingsOfPath(const WorldState& world, std::uint32_t slot, double time, FlightScratch& scratch) {
    if (!scratch.chains.meetsBacks) { return; }
    impactOfPath(world, slot, time, 1, scratch, true);
    noteCrossings(world, slot, pathOf(world, slot), 0, time, 1, scratch);
}

bool slideAlongSunk(WorldState& world, std::uint32_t slot, double time, FirstImpact& first, FlightScratch& scratch) {
    BodyMotion best = world.motions[slot];
    bool slides = false;
    FirstImpact next = first;
    for (int i = 0; i < kMostSlides && next.hit; ++i) {
        if (!setOff(world, slot, time, scratch.obstacles[next.obstacle])) { break; }
        next = impactOfPath(world, slot, time, 1, scratch);
        if (!next.hit || next.fraction > first.fraction) {
            first = next;
            best = world.motions[slot];
            slides = true;
        }
    }
    world.motions[slot] = best;
    return slides;
}

}  // namespace swept::inline SWEPT_PRECISION
