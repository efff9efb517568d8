#include "manifold_clip.h"

namespace swept::inline SWEPT_PRECISION {

Manifold singlePoint(const CorePoints& core, double coreSeparation, DVec2 normal, FeatureId id, const Polygon& a,
                     const Polygon& b, double margin) {
    const double radiusA = static_cast<double>(a.radius);
    const double radiusB = static_cast<double>(b.radius);
    Manifold manifold;
    manifold.normal = clampedReal(normal);
    if (coreSeparation - radiusA - radiusB > margin) { return manifold; }
    manifold.count = 1;
    manifold.points[0].point = clampedReal(core.a + (0.5 * (coreSeparation + radiusA - radiusB)) * normal);
    manifold.points[0].separation = clampedReal(coreSeparation - radiusA - radiusB);
    manifold.points[0].id = id;
    return manifold;
}

Manifold restored(const RescaledPair& scaled, Manifold manifold) {
    for (ManifoldPoint& p : manifold.points) {
        p.point = clampedReal(scaled.restored(toDouble(p.point)));
        p.separation = clampedReal(scaled.restored(static_cast<double>(p.separation)));
    }
    return manifold;
}

}  // namespace swept::inline SWEPT_PRECISION
