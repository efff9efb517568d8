#include "cast_start.h"

#include <algorithm>
#include <cmath>

#include "../../toi/toi_polygon.h"
#include "../flight/sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of a limit that leaves nothing of the way.
constexpr double kSmallestLimit = 0x1p-100;
/// How far a shape goes on that is pressed into what it is stopped by: far more than roundings of a body at rest, and
/// too little for the normal of anything round to turn.
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

}  // namespace

CarriedShape carriedFrom(const Polygon& polygon, const WorldTransform& pose, Vec2 translation) {
    const double angle = arcTangent2(static_cast<double>(pose.rotation.s), static_cast<double>(pose.rotation.c));
    const Sweep sweep{.c0 = pose.position, .c1 = pose.position + toDouble(translation), .a0 = angle, .a1 = angle};
    return {asToiPolygon(polygon), sweep, extentOf(polygon)};
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

CastStart startOf(const Shape& shape, const CarriedShape& carried, const Toi& toi) {
    if (toi.fraction > 0) { return CastStart::apart; }
    if (toi.separation < -slackOf(shape, carried)) { return CastStart::inside; }
    const DVec2 way = carried.sweep.c1 - carried.sweep.c0;
    const double nearer = -dot(way, toi.normal);
    const double rounding = static_cast<double>(kAlongRoundings * kEpsilon) * (std::fabs(way.x) + std::fabs(way.y));
    return nearer <= std::max(rounding, toi.separation) ? CastStart::leadsPast : CastStart::leadsInto;
}

Pressed pressedInto(const WorldState& world, const Shape& shape, const CarriedShape& carried) {
    const double way = length(carried.sweep.c1 - carried.sweep.c0);
    const double fraction = std::min(1.0, kBitOfClearance * clearanceOf(shape, carried) / way);
    const Toi farther = separationAt(asToiPolygon(shape.polygon), obstacleSweep(world, shape.body, 0, 0), carried.core,
                                     carried.sweep, fraction);
    return {farther.normal, -farther.separation};
}

DVec2 wayOut(const CarriedShape& carried, const Toi& toi) {
    return (dot(carried.lift, toi.normal) - toi.separation) * toi.normal;
}

std::optional<Support> supportOf(const WorldState& world, std::uint32_t slot, const CarriedShape& carried) {
    const Shape& shape = world.shapes[slot];
    const Toi toi = separationAt(asToiPolygon(shape.polygon), obstacleSweep(world, shape.body, 0, 0), carried.core,
                                 carried.sweep, 0);
    const double missing = clearanceOf(shape, carried) - toi.separation;
    if (!(missing > 0) || startOf(shape, carried, toi) != CastStart::leadsPast) { return std::nullopt; }
    return Support{slot, toi.normal, missing};
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
