#include "near_miss.h"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "../../shapes/distance.h"
#include "../../toi/time_of_impact.h"
#include "../../toi/toi_polygon.h"
#include "../bodies/travel.h"
#include "../state/tolerances.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What a body does in the step if nothing holds it.
struct FreeMotion {
    const BodyMotion& start;
    Vec2 velocity{};
    Real spin = 0;
    Vec2 pull{};  ///< m/s²

    FreeMotion(const WorldState& world, std::uint32_t slot) : start(world.motions[slot]) {
        const Body& body = world.bodies[slot];
        if (!body.awake && body.isDynamic()) { return; }
        velocity = start.velocity;
        spin = start.angularVelocity;
        if (body.isDynamic()) { pull = accelerationOf(world, body); }
    }
    Vec2 velocityAt(DVec2 point) const { return velocity + cross(spin, toReal(point - start.center)); }
    Sweep path(Vec2 localCenter, Real dt) const {
        const DVec2 fall = toDouble(square(dt) / 2 * pull);
        return {.localCenter = toDouble(localCenter),
                .c0 = start.center,
                .c1 = start.center + toDouble(dt * velocity) + fall,
                .k = fall,
                .a0 = start.angle,
                .a1 = start.angle + static_cast<double>(dt * spin)};
    }
};

/// How deep the solver would find a point at the end of the step, metres; at most 0: it would do nothing.
Real depthAhead(const WorldState& world, const Contact& contact, const FreeMotion& a, const FreeMotion& b, Real dt) {
    const WorldTransform& pose = world.motions[contact.bodyA].pose;
    const Vec2 normal = rotate(pose.rotation, contact.manifold.normal);
    const Real fall = -square(dt) / 2 * dot(b.pull - a.pull, normal);
    Real deepest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const DVec2 point = apply(pose, contact.manifold.points[i].point);
        const Real approach = -dot(b.velocityAt(point) - a.velocityAt(point), normal);
        deepest = std::max(deepest, dt * approach + fall - contact.manifold.points[i].separation);
    }
    return deepest;
}

WorldTransform endOf(const Sweep& path) {
    return poseOf(centerAt(path, 1), rotationFromAngle(angleAt(path, 1)), toReal(path.localCenter));
}

/// Pose of B in the frame of A.
Transform relativeAtEnd(const Sweep& pathA, const Sweep& pathB) {
    return relativeTransform(endOf(pathA), endOf(pathB));
}

/// How high above its core a point of a polygon's frame is, metres; below 0 in it, by how far the point would have to
/// move to leave it.
Real heightAbove(const Polygon& polygon, Vec2 point) {
    Real highest = -std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        highest = std::max(highest, dot(polygon.normals[i], point - polygon.vertices[i]));
    }
    return highest;
}

/// No less than the separation of two shapes, metres, where the foremost vertex of one is in the core of the other, as
/// mostly where they overlap; else infinity. Takes a tenth of what `distance` does.
/// @param normal  from A to B, frame of A
Real overlapBound(const Polygon& a, const Polygon& b, const Transform& bInA, Vec2 normal) {
    Real lowest = 0;
    if (a.count > 2) {
        const int foremost = supportIndex(b, unrotate(bInA.rotation, -normal));
        lowest = heightAbove(a, apply(bInA, b.vertices[static_cast<std::size_t>(foremost)]));
    }
    if (b.count > 2) {
        const int foremost = supportIndex(a, normal);
        lowest = std::min(lowest, heightAbove(b, applyInverse(bInA, a.vertices[static_cast<std::size_t>(foremost)])));
    }
    return lowest < 0 ? lowest - a.radius - b.radius : std::numeric_limits<Real>::infinity();
}

/// @param level  separation that counts as meeting, metres
bool arePathsApart(const Polygon& a, const Sweep& pathA, const Polygon& b, const Sweep& pathB, Real level,
                   Real tolerance) {
    const ToiSettings settings{.target = static_cast<double>(level), .tolerance = static_cast<double>(tolerance)};
    return timeOfImpact(asToiPolygon(a), pathA, asToiPolygon(b), pathB, settings).state == ToiState::separated;
}

/// Whether the solver would stop what does not meet on these paths, or only along an edge, by less than half of what
/// that would be, and less than the slop.
/// @param end  in: separation at the end, no less, metres; out: that of these paths
bool misses(const WorldState& world, const Contact& contact, const FreeMotion& a, const FreeMotion& b, Real dt,
            Real& end) {
    const Real depth = depthAhead(world, contact, a, b, dt);
    const Real grazed = std::min(kTargetRatio * contact.extent, depth / 2);
    if (!(depth > 0) || end <= -grazed) { return false; }
    const Polygon& shapeA = world.shapes[contact.shapeA].polygon;
    const Polygon& shapeB = world.shapes[contact.shapeB].polygon;
    const Sweep pathA = a.path(world.bodies[contact.bodyA].localCenter, dt);
    const Sweep pathB = b.path(world.bodies[contact.bodyB].localCenter, dt);
    const Transform bInA = relativeAtEnd(pathA, pathB);
    end = overlapBound(shapeA, shapeB, bInA, contact.manifold.normal);
    if (end <= -2 * kTargetRatio * contact.extent) { return false; }  // mostly they have met by the end
    end = distance(shapeA, shapeB, bInA).distance;
    if (end <= -grazed) { return false; }
    const Real radii = shapeA.radius + shapeB.radius;
    const Real level = -std::min(grazed, radii);
    if (end > level && arePathsApart(shapeA, pathA, shapeB, pathB, level, grazed / 8)) { return true; }
    if (radii >= grazed) { return false; }
    // No separation below zero is told of what has no radius: it goes that much beside its way instead.
    const DVec2 way = (pathB.c1 - pathB.c0) - (pathA.c1 - pathA.c0);
    const double far = length(way);
    if (!(far > 0)) { return false; }
    for (const double side : {1.0, -1.0}) {
        const DVec2 aside = side * static_cast<double>(grazed) / far * DVec2{-way.y, way.x};
        Sweep beside = pathB;
        beside.c0 += aside;
        beside.c1 += aside;
        const bool isPast = distance(shapeA, shapeB, relativeAtEnd(pathA, beside)).distance > 0;
        if (isPast && arePathsApart(shapeA, pathA, shapeB, beside, 0, grazed / 8)) { return true; }
    }
    return false;
}

}  // namespace

bool isNearMiss(const WorldState& world, const Contact& contact, Real dt) {
    if (world.watched && isAhead(world, contact)) { return false; }  // the mode is just that
    FreeMotion a(world, contact.bodyA);
    FreeMotion b(world, contact.bodyB);
    Real end = 0;
    if (misses(world, contact, a, b, dt, end)) { return true; }
    if (a.pull == b.pull) { return false; }
    // What something else carries does not fall: it goes straight on, beside the edge of what is flush with that.
    end += square(dt) / 2 * length(b.pull - a.pull);
    a.pull = b.pull = {};
    return misses(world, contact, a, b, dt, end);
}

}  // namespace swept::inline SWEPT_PRECISION
