#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "../../shapes/ray_cast.h"
#include "../queries.h"
#include "../state/tolerances.h"
#include "../world.h"
#include "cast_start.h"
#include "query_support.h"

/// What is called back may change the world, so nothing is gone through meanwhile that it might change: first all is
/// listed, then it is told.

namespace swept::inline SWEPT_PRECISION {
namespace {

CastHit rayAgainst(const WorldState& world, const Shape& shape, DVec2 origin, Vec2 translation, Real limit) {
    const WorldTransform& pose = world.motions[shape.body].pose;
    const RayCastHit local =
        rayCast(shape.polygon, applyInverse(pose, origin), unrotate(pose.rotation, translation), limit);
    CastHit hit;
    if (!local.hit) { return hit; }
    hit.hit = true;
    hit.shape = world.shapes.idOf(shape.head);
    hit.body = world.bodies.idOf(shape.body);
    hit.segment = shape.segmentIndex;
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
    double depth = 0;  ///< of a shape that is stopped as it starts: its overlap, metres; else 0
};

/// Of equal fractions the deeper comes first: at a seam of the ground the one that holds, not the edge beside. Then the
/// lower shape, of a chain the lower segment, so that the answer does not depend on the order in which they are found.
bool isBefore(const Met& a, const Met& b) {
    const auto key = [](const Met& m) {
        return std::make_tuple(m.hit.fraction, -m.depth, m.hit.shape.index, m.hit.segment);
    };
    return key(a) < key(b);
}

/// The first thing met so far.
class Closest {
public:
    void offer(const Met& met) {
        if (!first_.hit.hit || isBefore(met, first_)) { first_ = met; }
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
        return hit.hit ? std::min(limit, visit(Met{hit})) : limit;
    });
}

/// Lifts the shape off all that is near its start and that its way does not lead into.
/// @param start  a box around it
/// @return what that is, in the order of the slots
std::vector<Support> liftOff(const WorldState& world, const QueryFilter& filter, const Aabb& start,
                             CarriedShape& carried) {
    std::vector<Support> supports;  // asks for memory only where there are some
    world.broadphase->query(start, [&](ProxyId proxy) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(world, filter, world.shapes[slot])) { return true; }
        if (const std::optional<Support> support = supportOf(world, slot, carried)) { supports.push_back(*support); }
        return true;
    });
    lift(carried, supports);
    return supports;
}

/// Where there is little room, a shape that is lifted off one of its supports gets deeper into another one. It stays
/// past that: it is not really lifted.
bool isPassed(const std::vector<Support>& supports, std::uint32_t slot) {
    return std::any_of(supports.begin(), supports.end(),
                       [slot](const Support& s) { return s.slot == slot && s.isPassed; });
}

Met castAgainst(const WorldState& world, std::uint32_t slot, const CarriedShape& carried, Real limit) {
    const Shape& shape = world.shapes[slot];
    const Toi toi = castOf(world, shape, carried, static_cast<double>(limit));
    Met met;
    if (toi.state == ToiState::separated) { return met; }
    const Stance stance = stanceOf(world, shape, carried, toi);
    if (stance.start == CastStart::leadsPast) { return met; }
    met.hit.hit = true;
    met.hit.shape = world.shapes.idOf(shape.head);
    met.hit.body = world.bodies.idOf(shape.body);
    met.hit.segment = shape.segmentIndex;
    met.hit.fraction = static_cast<Real>(toi.fraction);
    met.hit.point = toi.pointA;
    met.depth = stance.depth;
    if (stance.start == CastStart::inside) {
        met.hit.wayOut = toReal(wayOut(carried, toi));
    } else {
        met.hit.normal = toReal(stance.normal);
    }
    return met;
}

/// Of the extent of what is carried: what is no farther off may count as touching at the start (cast_start.h).
constexpr Real kStartRoomRatio = Real(1) / 64;
static_assert(kStartRoomRatio > 4 * (kTargetRatio + kToleranceRatio));

/// Calls `visit` with what the shape meets on its way; it returns the fraction to go on with.
template <class Visit>
void visitOnWay(const WorldState& world, const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                const QueryFilter& filter, const Visit& visit) {
    if (!isGood(polygon, pose) || !isGood(pose.position, translation)) { return; }
    CarriedShape carried = carriedFrom(polygon, pose, translation);
    const Aabb start = grown(boundsOf(polygon, pose), kStartRoomRatio * carried.extent);
    const std::vector<Support> supports = liftOff(world, filter, start, carried);
    const Aabb lifted = grown(start, static_cast<Real>(length(carried.lift)));
    world.broadphase->sweep(lifted, toDouble(translation), 1, [&](ProxyId proxy, Real limit) {
        const std::uint32_t slot = slotOf(world, proxy);
        if (!sees(world, filter, world.shapes[slot]) || !(limit > 0) || isPassed(supports, slot)) { return limit; }
        const Met met = castAgainst(world, slot, carried, limit);
        return met.hit.hit ? std::min(limit, visit(met)) : limit;
    });
}

/// Tells of each shape or chain of which a part is near the box, seen and accepted, until a visit returns false.
/// Whether it is accepted is asked when its turn comes, as the world is then: most who ask end with the first.
/// @param state  of the world itself, since a visit may give it another
template <class Accepts>
void tellNear(const std::unique_ptr<WorldState>& state, const Aabb& box, const QueryFilter& filter,
              const Accepts& accepts, FunctionRef<bool(ShapeId)> visit) {
    std::vector<ShapeId> candidates;
    state->broadphase->query(box, [&](ProxyId proxy) {
        candidates.push_back(state->shapes.idOf(slotOf(*state, proxy)));
        return true;
    });
    ChainsSeen seen;
    for (const ShapeId part : candidates) {
        const Shape* shape = state->shapes.find(part);
        if (shape == nullptr || !sees(*state, filter, *shape) || !accepts(*shape) || !seen.isNew(*shape)) { continue; }
        if (!visit(state->shapes.idOf(shape->head))) { return; }
    }
}

/// Up to the fraction to which visits shorten the way.
void tellInOrder(const World& world, std::vector<Met>& found, FunctionRef<Real(const CastHit&)> visit) {
    std::sort(found.begin(), found.end(), isBefore);
    Real limit = 1;
    for (const Met& met : found) {
        if (!(limit > 0) || met.hit.fraction > limit) { return; }
        if (world.isValid(met.hit.shape)) { limit = std::min(limit, visit(met.hit)); }
    }
}

}  // namespace

void World::castRayAll(DVec2 origin, Vec2 translation, const QueryFilter& filter,
                       FunctionRef<Real(const CastHit&)> visit) const {
    std::vector<Met> found;
    visitOnRay(*state_, origin, translation, filter, [&found](const Met& met) {
        found.push_back(met);
        return Real(1);
    });
    tellInOrder(*this, found, visit);
}

CastHit World::castRay(DVec2 origin, Vec2 translation, const QueryFilter& filter) const {
    Closest closest;
    visitOnRay(*state_, origin, translation, filter, [&closest](const Met& met) {
        closest.offer(met);
        return closest.limit();
    });
    return closest.hit();
}

CastHit World::castRay(ShapeId id, DVec2 origin, Vec2 translation) const {
    const WorldState& world = *state_;
    if (!isValid(id) || !isGood(origin, translation)) { return {}; }
    Closest closest;
    for (std::uint32_t slot = id.index; slot != kNoIndex; slot = world.shapes[slot].nextInChain) {
        const CastHit hit = rayAgainst(world, world.shapes[slot], origin, translation, 1);
        if (hit.hit) { closest.offer(Met{hit}); }
    }
    return closest.hit();
}

void World::castShapeAll(const Polygon& polygon, const WorldTransform& pose, Vec2 translation,
                         const QueryFilter& filter, FunctionRef<Real(const CastHit&)> visit) const {
    std::vector<Met> found;
    visitOnWay(*state_, polygon, pose, translation, filter, [&found](const Met& met) {
        found.push_back(met);
        return Real(1);
    });
    tellInOrder(*this, found, visit);
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
    if (!overlaps(box, box)) { return; }  // lower > upper, or NaN; infinite bounds are as good as any
    const auto accepts = [this, &box](const Shape& shape) {
        return overlaps(box, boundsOf(shape.polygon, state_->motions[shape.body].pose));
    };
    tellNear(state_, box, filter, accepts, visit);
}

void World::overlapShape(const Polygon& polygon, const WorldTransform& pose, const QueryFilter& filter,
                         FunctionRef<bool(ShapeId)> visit) const {
    if (!isGood(polygon, pose)) { return; }
    const auto accepts = [this, &polygon, &pose](const Shape& shape) {
        return distanceTo(*state_, shape, polygon, pose).distance <= 0;
    };
    tellNear(state_, boundsOf(polygon, pose), filter, accepts, visit);
}

}  // namespace swept::inline SWEPT_PRECISION
