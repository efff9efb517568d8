#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "../queries.h"
#include "../world.h"
#include "query_support.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The search begins with a box that reaches this part of what is asked for, and takes a larger one each time that
/// nothing is in it: most of what is asked for is much nearer than it may be.
constexpr Real kFirstReach = Real(1) / (1 << 20);
constexpr Real kReachGrowth = 4;
/// A box that holds more than this is left, and one that reaches half as far beyond what is known to be empty taken:
/// far from all shapes, growth may have gone from none of them to all. So often, then it is searched whatever it holds.
constexpr int kMostInBox = 32;
constexpr int kMostCuts = 12;

/// No shape of a world, but what distances are taken to.
Polygon pointAtOrigin() {
    Polygon point;
    point.count = 1;
    return point;
}

/// Never more than the distance of what the boxes hold, metres.
Real gapOf(const Aabb& a, const Aabb& b) {
    const Vec2 gap = max(max(a.lower - b.upper, b.lower - a.upper), Vec2{});
    return roundedDown(static_cast<double>(std::max(gap.x, gap.y)) * (1 - static_cast<double>(kEpsilon)));
}

/// The nearest shape so far to a polygon. Of equal distances the lower shape counts, of a chain the lower segment, so
/// that the answer does not depend on the order of the visits.
class NearestSearch {
public:
    NearestSearch(const WorldState& world, const Polygon& polygon, const WorldTransform& pose)
        : world_(&world), polygon_(&polygon), pose_(&pose) {}

    void offer(std::uint32_t slot) {
        const Shape& shape = world_->shapes[slot];
        const Distance found = distanceTo(*world_, shape, *polygon_, *pose_);
        if (slot_ != kNoIndex && !isBefore(shape, found.distance)) { return; }
        best_ = found;
        slot_ = slot;
    }
    /// Infinity: nothing was found.
    Real least() const { return slot_ == kNoIndex ? std::numeric_limits<Real>::infinity() : best_.distance; }
    /// What is no farther than `reach`.
    NearestShape answer(Real reach) const {
        if (!(least() <= reach)) { return {}; }
        const Shape& shape = world_->shapes[slot_];
        const WorldTransform& frame = world_->motions[shape.body].pose;
        return {.found = true,
                .shape = world_->shapes.idOf(shape.head),
                .body = world_->bodies.idOf(shape.body),
                .segment = shape.segmentIndex,
                .distance = best_.distance,
                .point = apply(frame, best_.pointA),
                .normal = rotate(frame.rotation, best_.normal)};
    }

private:
    bool isBefore(const Shape& shape, Real distance) const {
        const Shape& best = world_->shapes[slot_];
        return std::tie(distance, shape.head, shape.segmentIndex) <
               std::tie(best_.distance, best.head, best.segmentIndex);
    }

    const WorldState* world_;
    const Polygon* polygon_;
    const WorldTransform* pose_;
    Distance best_;
    std::uint32_t slot_ = kNoIndex;
};

NearestShape nearestTo(const WorldState& world, const Polygon& polygon, const WorldTransform& pose, Real reach,
                       const QueryFilter& filter) {
    if (!(reach >= 0) || !isFinite(reach)) { return {}; }
    const Aabb own = boundsOf(polygon, pose);
    NearestSearch search(world, polygon, pose);
    Real empty = 0;
    constexpr Real kLeast = std::numeric_limits<Real>::min();
    Real looked = std::max(reach * kFirstReach, kLeast);
    int cuts = 0;
    while (true) {
        int visited = 0;
        const int most = cuts < kMostCuts ? kMostInBox : std::numeric_limits<int>::max();
        world.broadphase->query(grown(own, looked), [&](ProxyId proxy) {
            const std::uint32_t slot = slotOf(world, proxy);
            const bool mayBeNearest = gapOf(world.broadphase->box(proxy), own) <= std::max(search.least(), Real(0));
            if (mayBeNearest && sees(world, filter, world.shapes[slot])) { search.offer(slot); }
            return ++visited < most;
        });
        if (visited == most) {
            ++cuts;
            looked = std::min(looked, std::max(search.least(), empty));
            looked = empty + (looked - empty) / 2;
            continue;
        }
        // What is in the corner of a box may be farther than what is beside that.
        if (search.least() <= looked || looked >= reach) { return search.answer(reach); }
        empty = looked;
        looked = std::min({reach, std::max(looked, kLeast) * kReachGrowth, search.least()});
    }
}

}  // namespace

NearestShape World::nearest(DVec2 point, Real reach, const QueryFilter& filter) const {
    if (!isFinite(point)) { return {}; }
    return nearestTo(*state_, pointAtOrigin(), WorldTransform{point, {}}, reach, filter);
}

NearestShape World::nearest(const Polygon& polygon, const WorldTransform& pose, Real reach,
                            const QueryFilter& filter) const {
    if (!isGood(polygon, pose)) { return {}; }
    return nearestTo(*state_, polygon, pose, reach, filter);
}

NearestShape World::nearest(ShapeId id, DVec2 point) const {
    if (!isValid(id) || !isFinite(point)) { return {}; }
    const Polygon polygon = pointAtOrigin();
    const WorldTransform pose{point, {}};
    NearestSearch search(*state_, polygon, pose);
    for (std::uint32_t slot = id.index; slot != kNoIndex; slot = state_->shapes[slot].nextInChain) {
        search.offer(slot);
    }
    return search.answer(std::numeric_limits<Real>::infinity());
}

}  // namespace swept::inline SWEPT_PRECISION
