#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "../../shapes/ray_cast.h"
#include "cast_start.h"
#include "query_support.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

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

/// What a query meets of one shape, or one segment of a chain.
struct Met {
    CastHit hit;
    std::uint32_t slot = 0;
    double depth = 0;  ///< of a shape that is stopped as it starts: its overlap, metres; else 0
};

/// The first thing met so far. Of equal fractions the deeper counts: at a seam of the ground the one that holds, not
/// the edge beside. Then the lower shape, of a chain the lower segment, so that the answer does not depend on the order
/// of the visits.
class Closest {
public:
    void offer(const Met& met) {
        const auto key = [](const Met& m) {
            return std::make_tuple(m.hit.fraction, -m.depth, m.hit.shape.index, m.slot);
        };
        if (!first_.hit.hit || key(met) < key(first_)) { first_ = met; }
    }
    /// Beyond which nothing counts any more.
    Real limit() const { return std::nextafter(first_.hit.fraction, Real(2)); }
    const CastHit& hit() const { return first_.hit; }

private:
    Met first_;
};

/// Calls `visit` with what the ray meets; it returns the fraction to go on with.
template <class Visit>
void visitOnRay(const WorldState& world, DVec2 origin, Vec2 translation, const QueryFilter& filter,
                const Visit& visit) {
    if (!isGood(origin, translation)) { return; }
    world.broadphase->ray(origin, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(world, filter, world.shapes[slot])) { return limit; }
        const CastHit hit = rayAgainst(world, world.shapes[slot], origin, translation, limit);
        return hit.hit ? std::min(limit, visit(Met{hit, slot})) : limit;
    });
}

/// Lifts the shape off all that is near its start and that its way does not lead into. @param start  a box around it
void liftOff(const WorldState& world, const QueryFilter& filter, const Aabb& start, CarriedShape& carried) {
    std::vector<Support> supports;  // asks for memory only where there are some
    world.broadphase->query(start, [&](ProxyId proxy) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(world, filter, world.shapes[slot])) { return true; }
        if (const std::optional<Support> support = supportOf(world, slot, carried)) { supports.push_back(*support); }
        return true;
    });
    lift(carried, supports);
}

Met castAgainst(const WorldState& world, std::uint32_t slot, const CarriedShape& carried, Real limit) {
    const Shape& shape = world.shapes[slot];
    const Toi toi = castOf(world, shape, carried, static_cast<double>(limit));
    Met met{{}, slot};
    if (toi.state == ToiState::separated) { return met; }
    const CastStart start = startOf(shape, carried, toi);
    if (start == CastStart::leadsPast) { return met; }
    met.hit.hit = true;
    met.hit.shape = world.shapes.idOf(shape.head);
    met.hit.body = world.bodies.idOf(shape.body);
    met.hit.fraction = static_cast<Real>(toi.fraction);
    met.hit.point = toi.pointA;
    switch (start) {
        case CastStart::inside:
            met.hit.wayOut = toReal(wayOut(carried, toi));
            met.depth = -toi.separation;
            break;
        case CastStart::leadsInto: {
            const Pressed pressed = pressedInto(world, shape, carried);
            met.hit.normal = toReal(pressed.normal);
            met.depth = pressed.depth;
            break;
        }
        case CastStart::apart:
        case CastStart::leadsPast:
            met.hit.normal = toReal(toi.normal);
    }
    return met;
}

/// Calls `visit` with what the shape meets on its way; it returns the fraction to go on with.
template <class Visit>
void visitOnWay(const WorldState& world, const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                const QueryFilter& filter, const Visit& visit) {
    if (!isGood(polygon, pose) || !isGood(pose.position, translation)) { return; }
    CarriedShape carried = carriedFrom(polygon, pose, translation);
    const Aabb start = grown(boundsOf(polygon, pose), carried.extent / 64);
    liftOff(world, filter, start, carried);
    const Aabb lifted = grown(start, static_cast<Real>(length(carried.lift)));
    world.broadphase->sweep(lifted, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(world, filter, world.shapes[slot]) || !(limit > 0)) { return limit; }
        const Met met = castAgainst(world, slot, carried, limit);
        return met.hit.hit ? std::min(limit, visit(met)) : limit;
    });
}

}  // namespace

void World::castRayAll(DVec2 origin, Vec2 translation, const QueryFilter& filter,
                       FunctionRef<Real(const CastHit&)> visit) const {
    visitOnRay(*state_, origin, translation, filter, [&visit](const Met& met) { return visit(met.hit); });
}

CastHit World::castRay(DVec2 origin, Vec2 translation, const QueryFilter& filter) const {
    Closest closest;
    visitOnRay(*state_, origin, translation, filter, [&closest](const Met& met) {
        closest.offer(met);
        return closest.limit();
    });
    return closest.hit();
}

void World::castShapeAll(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                         const QueryFilter& filter, FunctionRef<Real(const CastHit&)> visit) const {
    visitOnWay(*state_, polygon, pose, translation, filter, [&visit](const Met& met) { return visit(met.hit); });
}

CastHit World::castShape(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                         const QueryFilter& filter) const {
    Closest closest;
    visitOnWay(*state_, polygon, pose, translation, filter, [&closest](const Met& met) {
        closest.offer(met);
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
        if (!overlapping || !sees(world, filter, shape) || !seen.isNew(shape)) { return true; }
        return visit(world.shapes.idOf(shape.head));
    });
}

void World::overlapShape(const Polygon& polygon, const WorldTransform& pose, const QueryFilter& filter,
                         FunctionRef<bool(ShapeId)> visit) const {
    const WorldState& world = *state_;
    if (!isGood(polygon, pose)) { return; }
    ChainsSeen seen;
    world.broadphase->query(boundsOf(polygon, pose), [&](ProxyId proxy) {
        const Shape& shape = shapeOf(world, proxy);
        if (!sees(world, filter, shape) || distanceTo(world, shape, polygon, pose).distance > 0) { return true; }
        if (!seen.isNew(shape)) { return true; }
        return visit(world.shapes.idOf(shape.head));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
