#include "distance.h"

#include "core_axis.h"
#include "gjk.h"
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

}  // namespace

Distance distance(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache) {
    const auto solve = [cache](const PairView& pair, int& iterations) {
        const GjkResult gjk = closestFeatures(pair, cache);
        if (cache != nullptr) {
            remember(gjk, *cache);
        }
        iterations = gjk.iterations;
        return coreSeparation(pair, gjk);
    };
    int iterations = 0;
    const RescaledPair scaled(a, b, bInA);
    if (!scaled.isNeeded()) {
        const CoreSeparation core = solve(PairView(a, b, bInA), iterations);
        return withRadii(core, iterations, a.radius, b.radius);
    }
    const Polygon scaledA = scaled.a();
    const Polygon scaledB = scaled.b();
    CoreSeparation core = solve(PairView(scaledA, scaledB, scaled.bInA()), iterations);
    core.separation = scaled.restored(core.separation);
    core.points = {scaled.restored(core.points.a), scaled.restored(core.points.b)};
    return withRadii(core, iterations, a.radius, b.radius);
}

}  // namespace swept::inline SWEPT_PRECISION
