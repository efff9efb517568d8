#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "../shapes/distance.h"
#include "../shapes/ray_cast.h"
#include "../toi/time_of_impact.h"
#include "../toi/toi_polygon.h"
#include "sweep_obstacles.h"
#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool sees(const QueryFilter& filter, const Shape& shape) {
    if (shape.def.sensor && !filter.sensors) { return false; }
    return (shape.def.filter.category & filter.mask) != 0 && (filter.category & shape.def.filter.mask) != 0;
}

std::uint32_t slotOf(const WorldState& world, ProxyId proxy) {
    return world.proxyShapes[static_cast<std::size_t>(proxy)];
}

const Shape& shapeOf(const WorldState& world, ProxyId proxy) { return world.shapes[slotOf(world, proxy)]; }

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

/// The first thing met so far. Of equal fractions the lower shape counts, of a chain the lower segment, so that the
/// answer does not depend on the order of the visits.
class Closest {
public:
    /// @param slot  of the shape, or segment
    void offer(const CastHit& hit, std::uint32_t slot) {
        if (hit_.hit &&
            std::tie(hit_.fraction, hit_.shape.index, slot_) <= std::tie(hit.fraction, hit.shape.index, slot)) {
            return;
        }
        hit_ = hit;
        slot_ = slot;
    }
    /// Beyond which nothing counts any more.
    Real limit() const { return std::nextafter(hit_.fraction, Real(2)); }
    const CastHit& hit() const { return hit_; }

private:
    CastHit hit_;
    std::uint32_t slot_ = 0;
};

/// Calls `visit` with what the ray meets and its slot; it returns the fraction to go on with.
template <class Visit>
void visitOnRay(const WorldState& world, DVec2 origin, Vec2 translation, const QueryFilter& filter,
                const Visit& visit) {
    if (!isGood(origin, translation)) { return; }
    world.broadphase->ray(origin, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(filter, world.shapes[slot])) { return limit; }
        const CastHit hit = rayAgainst(world, world.shapes[slot], origin, translation, limit);
        return hit.hit ? std::min(limit, visit(hit, slot)) : limit;
    });
}

/// A polygon being carried through the world.
struct CarriedShape {
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
    const ToiPolygon other = asToiPolygon(shape.polygon);
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

/// Calls `visit` with what the shape meets on its way and its slot; it returns the fraction to go on with.
template <class Visit>
void visitOnWay(const WorldState& world, const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                const QueryFilter& filter, const Visit& visit) {
    if (!validate(polygon).ok() || !isGood(pose.position, translation)) { return; }
    const double angle = arcTangent2(static_cast<double>(pose.rotation.s), static_cast<double>(pose.rotation.c));
    const CarriedShape carried{
        asToiPolygon(polygon),
        {.c0 = pose.position, .c1 = pose.position + toDouble(translation), .a0 = angle, .a1 = angle},
        extentOf(polygon)};
    const Aabb start = grown(boundsOf(polygon, pose), carried.extent / 64);
    world.broadphase->sweep(start, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(filter, world.shapes[slot]) || !(limit > 0)) { return limit; }
        const CastHit hit = castAgainst(world, world.shapes[slot], carried, limit);
        return hit.hit ? std::min(limit, visit(hit, slot)) : limit;
    });
}

}  // namespace

void World::castRayAll(DVec2 origin, Vec2 translation, const QueryFilter& filter,
                       FunctionRef<Real(const CastHit&)> visit) const {
    visitOnRay(*state_, origin, translation, filter,
               [&visit](const CastHit& hit, std::uint32_t) { return visit(hit); });
}

CastHit World::castRay(DVec2 origin, Vec2 translation, const QueryFilter& filter) const {
    Closest closest;
    visitOnRay(*state_, origin, translation, filter, [&closest](const CastHit& hit, std::uint32_t slot) {
        closest.offer(hit, slot);
        return closest.limit();
    });
    return closest.hit();
}

void World::castShapeAll(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                         const QueryFilter& filter, FunctionRef<Real(const CastHit&)> visit) const {
    visitOnWay(*state_, polygon, pose, translation, filter,
               [&visit](const CastHit& hit, std::uint32_t) { return visit(hit); });
}

CastHit World::castShape(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                         const QueryFilter& filter) const {
    Closest closest;
    visitOnWay(*state_, polygon, pose, translation, filter, [&closest](const CastHit& hit, std::uint32_t slot) {
        closest.offer(hit, slot);
        return closest.limit();
    });
    return closest.hit();
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
