#include "engine_query.h"

#include <algorithm>

namespace swept::bench {
namespace {

constexpr double kToleranceRatio = 0.25;  // of the slop
constexpr double kMargin = 1.02;          // a judge who counts in double should not count the last bits of a float
constexpr double kSmallest = 1e-6;        // metres; far below every slop, and far above what the engines are made for
constexpr double kLargest = 1e6;

/// Through memory: the vectoriser of GCC 12 takes a conversion to float and back for none (test EngineQuery).
double rounded(double x) {
    const volatile float nearest = static_cast<float>(x);
    return static_cast<double>(nearest);
}

DVec2 rounded(DVec2 v) { return {rounded(v.x), rounded(v.y)}; }

ToiPolygon rounded(ToiPolygon polygon) {
    for (DVec2& vertex : polygon.vertices) { vertex = rounded(vertex); }
    polygon.radius = rounded(polygon.radius);
    return polygon;
}

Sweep rounded(const Sweep& sweep) {
    Sweep result = sweep;
    result.localCenter = rounded(sweep.localCenter);
    result.c0 = rounded(sweep.c0);
    result.c1 = rounded(sweep.c1);
    result.a0 = rounded(sweep.a0);
    result.a1 = rounded(sweep.a1);
    return result;
}

double size(const ToiPolygon& polygon) {
    double largest = polygon.radius;
    for (int i = 0; i < polygon.count; ++i) {
        largest = std::max(largest, length(polygon.vertices[static_cast<std::size_t>(i)]));
    }
    return largest;
}

bool isInRange(const ToiPolygon& polygon) { return size(polygon) > kSmallest && size(polygon) < kLargest; }

}  // namespace

std::optional<ToiQuery> engineQuery(const ToiQuery& query, const EngineContract& contract) {
    const bool isStraight = query.sweepA.k == DVec2{} && query.sweepB.k == DVec2{};
    if (!isStraight || !isInRange(query.a) || !isInRange(query.b)) { return std::nullopt; }
    ToiQuery result{rounded(query.a), rounded(query.sweepA), rounded(query.b), rounded(query.sweepB), query.settings};
    const double radii = result.a.radius + result.b.radius;
    result.settings.target = std::max(contract.slop, radii - contract.slopsInside * contract.slop) - radii;
    result.settings.tolerance = kMargin * kToleranceRatio * contract.slop;
    result.settings.tMax = rounded(query.settings.tMax);
    if (!validateToiPolygon(result.a).ok() || !validateToiPolygon(result.b).ok()) { return std::nullopt; }
    return result;
}

}  // namespace swept::bench
