#include <algorithm>
#include <limits>
#include <vector>

#include <swept/shapes/hull.h>
#include <swept/toi/time_of_impact.h>
#include <swept/toi/toi_polygon.h>

#include "fuzz_targets.h"

namespace swept::test {
namespace {

constexpr int kSamples = 24;
// Iterations grow with the turns of a sweep, as documented: more of them only make the fuzzer slow.
constexpr double kMostAngle = 50;
// So they do with shapes that are so many times as long as the distance to be found is: what turns past such a point at
// its side may come nearer by a small part of its length at most, step by step (a sliver of 65 000 km by 130 m, 28 km
// beside a point, took more than there are).
constexpr double kMostLengths = 1 << 26;

ToiPolygon polygonFrom(FuzzInput& input) {
    std::vector<Vec2> points(static_cast<std::size_t>(input.below(8)));
    for (Vec2& p : points) {
        const double x = input.number();
        p = {static_cast<Real>(x), static_cast<Real>(input.number())};
    }
    const auto radius = static_cast<Real>(input.flag() ? input.number() : 0.0);
    if (const Result<Polygon> hull = convexHull(points, radius); hull.ok()) { return asToiPolygon(hull.value()); }
    ToiPolygon raw;  // a point, a segment, or something to be refused
    raw.count = static_cast<int>(points.size());
    raw.radius = static_cast<double>(radius);
    for (std::size_t i = 0; i < points.size(); ++i) { raw.vertices[i] = toDouble(points[i]); }
    return raw;
}

DVec2 vectorFrom(FuzzInput& input) {
    const double x = input.number();
    return {x, input.number()};
}

Sweep sweepFrom(FuzzInput& input) {
    Sweep sweep;
    sweep.localCenter = vectorFrom(input);
    sweep.c0 = vectorFrom(input);
    sweep.c1 = vectorFrom(input);
    if (input.flag()) { sweep.k = vectorFrom(input); }
    sweep.a0 = input.number();
    sweep.a1 = sweep.a0 + std::clamp(input.number(), -kMostAngle, kMostAngle);
    return sweep;
}

/// What rounding may make of a separation: both poses are products and sums of such numbers.
double roundingOf(const Sweep& a, const Sweep& b, double sizes) {
    const double lengths[] = {a.c0.x, a.c0.y, a.c1.x, a.c1.y, a.k.x, a.k.y, a.localCenter.x, a.localCenter.y,
                              b.c0.x, b.c0.y, b.c1.x, b.c1.y, b.k.x, b.k.y, b.localCenter.x, b.localCenter.y};
    double largest = sizes;
    for (const double length : lengths) { largest = std::max(largest, std::fabs(length)); }
    return 64 * std::numeric_limits<double>::epsilon() * largest *
           (1 + std::fabs(a.a0) + std::fabs(b.a0) + 2 * kMostAngle);
}

double sizeOf(const ToiPolygon& polygon) {
    double size = polygon.radius;
    for (int i = 0; i < polygon.count; ++i) {
        const DVec2 p = polygon.vertices[static_cast<std::size_t>(i)];
        size = std::max({size, std::fabs(p.x), std::fabs(p.y)});
    }
    return size;
}

}  // namespace

void fuzzToi(Bytes bytes) {
    FuzzInput input(bytes);
    const ToiPolygon a = polygonFrom(input);
    const ToiPolygon b = polygonFrom(input);
    const Sweep sweepA = sweepFrom(input);
    const Sweep sweepB = sweepFrom(input);
    ToiSettings settings = defaultToiSettings(a, b);
    if (input.flag()) { settings.target = input.number(); }
    if (input.flag()) { settings.tolerance = input.number(); }
    if (input.flag()) { settings.tMax = input.number(); }
    const Status status = validateToi(a, sweepA, b, sweepB, settings);
    if (!status.ok()) {
        demand(status.field[0] != '\0', "an error names what is wrong");
        return;
    }
    const Toi toi = timeOfImpact(a, sweepA, b, sweepB, settings);
    const bool isExtreme = sizeOf(a) + sizeOf(b) > kMostLengths * std::fabs(settings.target);
    demand(toi.state != ToiState::failed || isExtreme, "a valid query has an answer");
    demand(toi.fraction >= 0 && toi.fraction <= settings.tMax, "the fraction lies in the search");
    demand(std::isfinite(toi.separation) && isFinite(toi.pointA) && isFinite(toi.pointB), "answers are finite");
    if (toi.state == ToiState::overlapped) { return; }
    const double rounding = roundingOf(sweepA, sweepB, sizeOf(a) + sizeOf(b));
    const auto separation = [&](double t) { return separationAt(a, sweepA, b, sweepB, t).separation; };
    if (toi.state == ToiState::hit && toi.fraction > 0) {
        demand(std::fabs(separation(toi.fraction) - settings.target) <= settings.tolerance + rounding,
               "a hit touches within the tolerance");
    }
    for (int i = 0; i < kSamples; ++i) {
        const double t = toi.fraction * i / kSamples;
        if (t < toi.fraction) {
            demand(separation(t) > settings.target - settings.tolerance - rounding, "nothing is hit before");
        }
    }
}

}  // namespace swept::test
