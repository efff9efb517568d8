#include "distance.h"

#include "compiler.h"
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

/// Whether neither a product of four coordinates leaves the range of double nor an answer that of `Real`.
bool isInRange(const Polygon& a, const Polygon& b, const GjkResult& gjk) {
    constexpr bool isFloat = std::is_same_v<Real, float>;
    constexpr double kLargest = isFloat ? 0x1p120 : 0x1p200;
    const double size = gjk.resolution / kResolution;
    return size < kLargest && static_cast<double>(a.radius + b.radius) < kLargest && (isFloat || size > 1 / kLargest);
}

/// Overlap, what a walk does not prove, coordinates near the ends of the range. Never inline: its large locals would
/// burden the common case.
SWEPT_COLD Distance distanceWithCare(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache) {
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
    // The common case without a call: apart, and coordinates that double can multiply.
    GjkResult gjk;
    if (!gjk::walk(pair, gjk::start(pair, cache), gjk) || !isInRange(a, b, gjk)) {
        return distanceWithCare(a, b, bInA, cache);
    }
    if (cache != nullptr) { remember(gjk, *cache); }
    const double rA = static_cast<double>(a.radius);
    const double rB = static_cast<double>(b.radius);
    return {static_cast<Real>(gjk.distance - rA - rB), toReal(gjk.normal),
            toReal(gjk.points.a + rA * gjk.normal),    toReal(gjk.points.b - rB * gjk.normal),
            static_cast<Real>(gjk.distance),           gjk.iterations};
}

}  // namespace swept::inline SWEPT_PRECISION
