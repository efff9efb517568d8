#include "distance.h"

#include "core_axis.h"
#include "gjk_run.h"
#include "rescaled_pair.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Distance withRadii(const CoreSeparation& core, int iterations, Real radiusA, Real radiusB) {
    const double rA = static_cast<double>(radiusA);
    const double rB = static_cast<double>(radiusB);
    Distance d;
    d.distance = clampedReal(core.separation - rA - rB);
    d.normal = clampedReal(core.normal);
    d.pointA = clampedReal(core.points.a + rA * core.normal);
    d.pointB = clampedReal(core.points.b - rB * core.normal);
    d.coreDistance = clampedReal(core.separation);
    d.iterations = iterations;
    return d;
}

/// Whether no product of four coordinates left the range of double (a float's never does).
bool isInRange(const GjkResult& gjk) {
    if constexpr (std::is_same_v<Real, float>) { return true; }
    constexpr double kLargest = 0x1p200;
    const double size = gjk.resolution / kResolution;
    return size < kLargest && size > 1 / kLargest;
}

/// Overlap, runs that stalled, coordinates near the ends of the range.
Distance distanceWithCare(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache) {
    int iterations = 0;
    const auto solve = [cache, &iterations](const PairView& pair) {
        const GjkResult gjk = closestFeatures(pair, cache);
        if (cache != nullptr) { remember(gjk, *cache); }
        iterations = gjk.iterations;
        return coreSeparation(pair, gjk);
    };
    const RescaledPair scaled(a, b, bInA);
    if (!scaled.isNeeded()) {
        const CoreSeparation core = solve(PairView(a, b, bInA));
        return withRadii(core, iterations, a.radius, b.radius);
    }
    const Polygon scaledA = scaled.a();
    const Polygon scaledB = scaled.b();
    CoreSeparation core = solve(PairView(scaledA, scaledB, scaled.bInA()));
    core.separation = scaled.restored(core.separation);
    core.points = {scaled.restored(core.points.a), scaled.restored(core.points.b)};
    return withRadii(core, iterations, a.radius, b.radius);
}

}  // namespace

Distance distance(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache) {
    const PairView pair(a, b, bInA);
    GjkResult gjk;
    gjk::run(pair, cache, gjk);
    // The common case first, without a call: apart, and coordinates that double can multiply.
    if (gjk.outcome != GjkOutcome::apart || !isInRange(gjk)) { return distanceWithCare(a, b, bInA, cache); }
    if (cache != nullptr) { remember(gjk, *cache); }
    return withRadii({gjk.distance, gjk.normal, witnessOf(pair, gjk, gjk.distance * gjk.normal)}, gjk.iterations,
                     a.radius, b.radius);
}

}  // namespace swept::inline SWEPT_PRECISION
