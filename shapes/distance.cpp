#include "distance.h"

#include "core_axis.h"
#include "gjk.h"
#include "rescaled_pair.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void remember(const GjkResult& r, SimplexCache& cache) {
    cache.count = static_cast<std::uint8_t>(r.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(r.count); ++i) {
        cache.indexA[i] = static_cast<std::uint8_t>(r.simplex[i].a);
        cache.indexB[i] = static_cast<std::uint8_t>(r.simplex[i].b);
    }
}

/// Separation, normal and witness points without radii.
struct CoreDistance {
    double separation = 0;
    DVec2 normal;
    DVec2 pointA;
    DVec2 pointB;
    int iterations = 0;
};

CoreDistance coreDistance(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache) {
    const PairView pair(a, b, bInA);
    const GjkResult gjk = closestFeatures(pair, cache);
    if (cache != nullptr) { remember(gjk, *cache); }
    if (gjk.outcome == GjkOutcome::apart) {
        const CorePoints points = witnessOf(pair, gjk);
        return {gjk.distance, gjk.normal, points.a, points.b, gjk.iterations};
    }
    const CoreAxis axis = coreAxis(pair);
    const CorePoints points = corePoints(pair, axis);
    return {axis.separation, axis.normal, points.a, points.b, gjk.iterations};
}

Distance withRadii(const CoreDistance& core, Real radiusA, Real radiusB) {
    const double rA = static_cast<double>(radiusA);
    const double rB = static_cast<double>(radiusB);
    Distance d;
    d.distance = clampedReal(core.separation - rA - rB);
    d.normal = clampedReal(core.normal);
    d.pointA = clampedReal(core.pointA + rA * core.normal);
    d.pointB = clampedReal(core.pointB - rB * core.normal);
    d.coreDistance = clampedReal(core.separation);
    d.iterations = core.iterations;
    return d;
}

}  // namespace

Distance distance(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache) {
    const RescaledPair scaled(a, b, bInA);
    if (!scaled.isNeeded()) { return withRadii(coreDistance(a, b, bInA, cache), a.radius, b.radius); }
    CoreDistance core = coreDistance(scaled.a(), scaled.b(), scaled.bInA(), cache);
    core.separation = scaled.restored(core.separation);
    core.pointA = scaled.restored(core.pointA);
    core.pointB = scaled.restored(core.pointB);
    return withRadii(core, a.radius, b.radius);
}

}  // namespace swept::inline SWEPT_PRECISION
