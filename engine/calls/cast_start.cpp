#include "cast_start.h"

#include <algorithm>
#include <cmath>

#include "../../toi/toi_polygon.h"
#include "../flight/sweep_obstacles.h"
#include "../flight/sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of a limit that leaves nothing of the way.
constexpr double kSmallestLimit = 0x1p-100;
/// How far a shape goes on to tell which side of a corner it is pressed into: far more than roundings of a body at
/// rest.
constexpr double kBitOfClearance = 1.0 / 16;

/// Deeper than this, metres, no contact holds a body (`kSlackRatio`): it is inside.
double slackOf(const Shape& shape, const CarriedShape& carried) {
    constexpr auto kSlackTargets = static_cast<double>(kSlackRatio / kTargetRatio);
    return kSlackTargets * defaultToiSettings(asToiPolygon(shape.polygon), carried.core).target;
}

/// Metres: above what counts as touching, with any shape, however small or large the one is that carries it.
double clearanceOf(const Shape& shape, const CarriedShape& carried) {
    const ToiSettings settings = defaultToiSettings(asToiPolygon(shape.polygon), carried.core);
    const double own = static_cast<double>(carried.extent * kTargetRatio);
    return std::max(own, settings.target) * static_cast<double>((kTargetRatio + kToleranceRatio) / kTargetRatio);
}

double bitOf(const Shape& shape, const CarriedShape& carried) { return kBitOfClearance * clearanceOf(shape, carried); }

/// Metres that the way goes against a normal; negative: away from it.
double nearerBy(const CarriedShape& carried, DVec2 normal) { return -dot(carried.way, normal); }

/// Of the way, against a normal it was made to go along.
double roundingOf(const CarriedShape& carried) {
    return static_cast<double>(kAlongRoundings * kEpsilon) * (std::fabs(carried.way.x) + std::fabs(carried.way.y));
}

/// No separation is less than that along a direction: what leads past along one normal is past all of the shape.
bool leadsPast(const CarriedShape& carried, DVec2 normal, double separation) {
    return nearerBy(carried, normal) <= std::max(roundingOf(carried), separation);
}

/// Metres, along the normal, of the overlap that it has where it was asked for.
double depthUnlifted(const CarriedShape& carried, const Toi& toi) {
    return dot(carried.lift, toi.normal) - toi.separation;
}

/// Not only because it was lifted off something else, where there is little room.
bool isInside(const Shape& shape, const CarriedShape& carried, const Toi& toi) {
    return std::min(-toi.separation, depthUnlifted(carried, toi)) > slackOf(shape, carried);
}

/// Where cores are apart there is one normal, whatever the way. That of a bit farther on is another one: over a corner
/// the normal turns with the round shape that is carried along.
bool hasOneNormal(const Shape& shape, const CarriedShape& carried, const Toi& toi) {
    const double radii = static_cast<double>(shape.polygon.radius) + carried.core.radius;
    return toi.separation + radii > bitOf(shape, carried);
}

Toi aBitFarther(const WorldState& world, const Shape& shape, const CarriedShape& carried) {
    const double fraction = std::min(1.0, bitOf(shape, carried) / length(carried.way));
    return separationAt(asToiPolygon(shape.polygon), obstacleSweep(world, shape.body, 0, 0), carried.core,
                        carried.sweep, fraction);
}

double alongAtStart(const WorldState& world, const Shape& shape, const CarriedShape& carried, DVec2 normal) {
    return separationAlong(asToiPolygon(shape.polygon), obstacleSweep(world, shape.body, 0, 0), carried.core,
                           carried.sweep, 0, normal);
}

}  // namespace

CarriedShape carriedFrom(const Polygon& polygon, const WorldTransform& pose, Vec2 translation) {
    const double angle = arcTangent2(static_cast<double>(pose.rotation.s), static_cast<double>(pose.rotation.c));
    const DVec2 way = toDouble(translation);
    const Sweep sweep{.c0 = pose.position, .c1 = pose.position + way, .a0 = angle, .a1 = angle};
    return {asToiPolygon(polygon), sweep, way, extentOf(polygon)};
}

Toi castOf(const WorldState& world, const Shape& shape, const CarriedShape& carried, double limit) {
    const ToiPolygon other = asToiPolygon(shape.polygon);
    ToiSettings settings = defaultToiSettings(other, carried.core);
    // Where something was met at the start, all else that is near counts as met there as well, though it is a bit off.
    settings.tMax = limit < kSmallestLimit ? 1 : limit;
    Toi toi = shapeCast(other, obstacleSweep(world, shape.body, 0, 0), carried.core, carried.sweep, settings);
    if (toi.fraction > limit) { toi.state = ToiState::separated; }
    return toi;
}

Stance stanceOf(const WorldState& world, const Shape& shape, const CarriedShape& carried, const Toi& toi) {
    if (toi.fraction > 0) { return {CastStart::apart, toi.normal}; }
    if (isInside(shape, carried, toi)) { return {CastStart::inside, toi.normal, -toi.separation}; }
    if (leadsPast(carried, toi.normal, toi.separation)) { return {CastStart::leadsPast, toi.normal, -toi.separation}; }
    if (hasOneNormal(shape, carried, toi)) { return {CastStart::leadsInto, toi.normal, -toi.separation}; }
    // Where polygons touch at a corner, or overlap, any normal is as good at the start; a bit farther on one is. As the
    // separation of convex shapes is convex, a way along the one that another way is stopped with is past its own, too.
    const Toi farther = aBitFarther(world, shape, carried);
    const double along = alongAtStart(world, shape, carried, farther.normal);
    if (leadsPast(carried, farther.normal, along)) { return {CastStart::leadsPast, farther.normal, -along}; }
    return {CastStart::leadsInto, farther.normal, -farther.separation};
}

DVec2 wayOut(const CarriedShape& carried, const Toi& toi) { return depthUnlifted(carried, toi) * toi.normal; }

std::optional<Support> supportOf(const WorldState& world, std::uint32_t slot, const CarriedShape& carried) {
    const Shape& shape = world.shapes[slot];
    const Toi toi = separationAt(asToiPolygon(shape.polygon), obstacleSweep(world, shape.body, 0, 0), carried.core,
                                 carried.sweep, 0);
    const double clearance = clearanceOf(shape, carried);
    if (!(toi.separation < clearance)) { return std::nullopt; }
    const Stance stance = stanceOf(world, shape, carried, toi);
    if (stance.start != CastStart::leadsPast) { return std::nullopt; }
    const bool isPassed = nearerBy(carried, stance.normal) <= roundingOf(carried);
    return Support{slot, stance.normal, clearance + stance.depth, isPassed};
}

void lift(CarriedShape& carried, std::vector<Support>& supports) {
    std::sort(supports.begin(), supports.end(), [](const Support& a, const Support& b) { return a.slot < b.slot; });
    for (const Support& support : supports) {
        const double missing = support.missing - dot(carried.lift, support.normal);
        if (missing > 0) { carried.lift = carried.lift + missing * support.normal; }
    }
    carried.sweep.c0 = carried.sweep.c0 + carried.lift;
    carried.sweep.c1 = carried.sweep.c1 + carried.lift;
}

}  // namespace swept::inline SWEPT_PRECISION
