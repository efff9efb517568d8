#include <algorithm>
#include <cmath>

#include "../shapes/distance.h"
#include "../shapes/ray_cast.h"
#include "../toi/time_of_impact.h"
#include "sweep_obstacles.h"
#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool sees(const QueryFilter& filter, const Shape& shape) {
    if (shape.def.sensor && !filter.sensors) { return false; }
    return (shape.def.filter.category & filter.mask) != 0 && (filter.category & shape.def.filter.mask) != 0;
}

const Shape& shapeOf(const WorldState& world, ProxyId proxy) {
    return world.shapes[world.proxyShapes[static_cast<std::size_t>(proxy)]];
}

CastHit rayAgainst(const WorldState& world, const Shape& shape, DVec2 origin, Vec2 translation, Real limit) {
    const WorldTransform& pose = world.motions[shape.body].pose;
    const RayCastHit local =
        rayCast(shape.polygon, applyInverse(pose, origin), unrotate(pose.rotation, translation), limit);
    CastHit hit;
    if (!local.hit) { return hit; }
    hit.hit = true;
    hit.shape = world.shapes.idOf(shape.head);
    hit.body = world.bodies.idOf(shape.body);
    hit.fraction = local.fraction;
    hit.point = apply(pose, local.point);
    hit.normal = rotate(pose.rotation, local.normal);
    return hit;
}

/// A chain has one id, however many of its segments a query meets.
class ChainsSeen {
public:
    bool isNew(const Shape& shape) {
        if (!shape.isChainSegment) { return true; }
        if (std::find(heads_.begin(), heads_.end(), shape.head) != heads_.end()) { return false; }
        heads_.push_back(shape.head);
        return true;
    }

private:
    std::vector<std::uint32_t> heads_;  // asks for memory only where there are chains, and outside of steps
};

bool isGood(DVec2 origin, Vec2 translation) {
    return isFinite(origin) && isFinite(translation) && translation != Vec2{};
}

Distance distanceTo(const WorldState& world, const Shape& shape, const Polygon& polygon, const WorldTransform& pose) {
    return distance(shape.polygon, polygon, relativeTransform(world.motions[shape.body].pose, pose));
}

/// A polygon being carried through the world.
struct CarriedShape {
    const Polygon& polygon;
    ToiPolygon core;
    Sweep sweep;
    Real extent;
};

/// Near enough at the start to count as touching, but never nearer than apart along that normal, all the way: what
/// slides along a wall, or leaves it, is not stopped by it.
bool leadsPast(const Toi& toi, const Sweep& sweep) {
    const bool isNearAtStart = toi.state == ToiState::hit && !(toi.fraction > 0) && toi.separation > 0;
    return isNearAtStart && toi.separation + dot(sweep.c1 - sweep.c0, toi.normal) > 0;
}

/// Coordinates of the cast relative to its start, so that nothing is lost far from the origin.
CastHit castAgainst(const WorldState& world, const Shape& shape, const CarriedShape& carried, Real limit) {
    const ToiPolygon other = toiPolygonOf(shape.polygon);
    const Sweep still = obstacleSweep(world, shape.body, 0, 0);
    ToiSettings settings = defaultToiSettings(other, carried.core);
    settings.tMax = static_cast<double>(limit);
    const Toi toi = shapeCast(other, still, carried.core, carried.sweep, settings);
    CastHit hit;
    if (toi.state == ToiState::separated || leadsPast(toi, carried.sweep)) { return hit; }
    hit.hit = true;
    hit.shape = world.shapes.idOf(shape.head);
    hit.body = world.bodies.idOf(shape.body);
    hit.fraction = static_cast<Real>(toi.fraction);
    hit.point = toi.pointA;
    const bool isInside = toi.state == ToiState::overlapped || toi.separation < 0;
    hit.normal = isInside ? Vec2{} : toReal(toi.normal);
    return hit;
}

}  // namespace

void World::castRayAll(DVec2 origin, Vec2 translation, const QueryFilter& filter,
                       FunctionRef<Real(const CastHit&)> visit) const {
    const WorldState& world = *state_;
    if (!isGood(origin, translation)) { return; }
    world.broadphase->ray(origin, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const Shape& shape = shapeOf(world, proxy);
        if (!sees(filter, shape)) { return limit; }
        const CastHit hit = rayAgainst(world, shape, origin, translation, limit);
        return hit.hit ? std::min(limit, visit(hit)) : limit;
    });
}

CastHit World::castRay(DVec2 origin, Vec2 translation, const QueryFilter& filter) const {
    CastHit closest;
    castRayAll(origin, translation, filter, [&closest](const CastHit& hit) {
        // Equal fractions: the lower shape, so that the answer does not depend on the order of the visits.
        const bool closer = !closest.hit || hit.fraction < closest.fraction ||
                            (hit.fraction == closest.fraction && hit.shape.index < closest.shape.index);
        if (closer) { closest = hit; }
        return std::nextafter(closest.fraction, Real(2));
    });
    return closest;
}

CastHit World::castShape(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                         const QueryFilter& filter) const {
    const WorldState& world = *state_;
    CastHit closest;
    const bool good = validate(polygon).ok() && isGood(pose.position, translation);
    if (!good) { return closest; }
    const double angle = arcTangent2(static_cast<double>(pose.rotation.s), static_cast<double>(pose.rotation.c));
    const CarriedShape carried{
        polygon,
        toiPolygonOf(polygon),
        {.c0 = pose.position, .c1 = pose.position + toDouble(translation), .a0 = angle, .a1 = angle},
        extentOf(polygon)};
    const Aabb start = grown(boundsOf(polygon, pose), carried.extent / 64);
    world.broadphase->sweep(start, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const Shape& shape = shapeOf(world, proxy);
        if (!sees(filter, shape) || !(limit > 0)) { return limit; }
        const CastHit hit = castAgainst(world, shape, carried, limit);
        if (!hit.hit) { return limit; }
        const bool closer = !closest.hit || hit.fraction < closest.fraction ||
                            (hit.fraction == closest.fraction && hit.shape.index < closest.shape.index);
        if (closer) { closest = hit; }
        return std::min(std::nextafter(closest.fraction, Real(2)), limit);
    });
    return closest;
}

void World::queryBox(const Aabb& box, const QueryFilter& filter, FunctionRef<bool(ShapeId)> visit) const {
    const WorldState& world = *state_;
    if (!swept::isValid(box)) { return; }
    ChainsSeen seen;
    world.broadphase->query(box, [&](ProxyId proxy) {
        const Shape& shape = shapeOf(world, proxy);
        const bool overlapping = overlaps(box, boundsOf(shape.polygon, world.motions[shape.body].pose));
        if (!overlapping || !sees(filter, shape) || !seen.isNew(shape)) { return true; }
        return visit(world.shapes.idOf(shape.head));
    });
}

void World::overlapShape(const Polygon& polygon, const WorldTransform& pose, const QueryFilter& filter,
                         FunctionRef<bool(ShapeId)> visit) const {
    const WorldState& world = *state_;
    if (!validate(polygon).ok() || !isFinite(pose.position)) { return; }
    ChainsSeen seen;
    world.broadphase->query(boundsOf(polygon, pose), [&](ProxyId proxy) {
        const Shape& shape = shapeOf(world, proxy);
        if (!sees(filter, shape) || distanceTo(world, shape, polygon, pose).distance > 0) { return true; }
        if (!seen.isNew(shape)) { return true; }
        return visit(world.shapes.idOf(shape.head));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
