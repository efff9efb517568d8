#include "penetration.h"

#include "core_axis.h"
#include "rescaled_pair.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A point of the incident shape that lies over the reference face [start, start + edge] and as low as `support`. That
/// is `support` itself, unless its edge is parallel to the face and it sticks out at the side.
template <class VertexAt>
DVec2 overFace(DVec2 start, DVec2 edge, DVec2 normal, const Polygon& incident, int support, const VertexAt& vertexAt) {
    const DVec2 v = vertexAt(support);
    const double along = dot(edge, v - start);
    const double end = dot(edge, edge);
    if (incident.count < 2 || (along >= 0 && along <= end)) { return v; }
    const DVec2 next = vertexAt(incident.next(support));
    const DVec2 previous = vertexAt(incident.previous(support));
    const DVec2 span = (dot(normal, next - v) < dot(normal, previous - v) ? next : previous) - v;
    const double slope = dot(edge, span);
    const double wanted = (along < 0 ? 0 : end) - along;
    if (!(wanted * slope > 0)) { return v; }
    const double fraction = wanted / slope;
    return v + (fraction < 1 ? fraction : 1) * span;
}

}  // namespace

CorePoints corePoints(const PairView& pair, const CoreAxis& axis) {
    const DVec2 gap = axis.separation * axis.normal;
    switch (axis.source) {
        case AxisSource::faceOfA: {
            const DVec2 b = overFace(pair.vertexA(axis.face), pair.edgeA(axis.face), axis.normal, pair.b, axis.supportB,
                                     [&pair](int i) { return pair.vertexB(i); });
            return {b - gap, b};
        }
        case AxisSource::faceOfB: {
            const DVec2 a = overFace(pair.vertexB(axis.face), pair.edgeB(axis.face), -axis.normal, pair.a,
                                     axis.supportA, [&pair](int i) { return pair.vertexA(i); });
            return {a, a + gap};
        }
        case AxisSource::direction:
            break;
    }
    const DVec2 a = pair.vertexA(axis.supportA);
    return {a, a + gap};
}

Penetration penetration(const Polygon& a, const Polygon& b, const Transform& bInA) {
    const RescaledPair scaled(a, b, bInA);
    const auto solve = [](const PairView& pair, const auto& restored) {
        const CoreAxis axis = coreAxis(pair);
        const CorePoints points = corePoints(pair, axis);
        return Penetration{clampedReal(restored(axis.separation)), clampedReal(axis.normal),
                           clampedReal(restored(points.a)), clampedReal(restored(points.b))};
    };
    if (!scaled.isNeeded()) {
        return solve(PairView(a, b, bInA), [](auto x) { return x; });
    }
    const Polygon scaledA = scaled.a();
    const Polygon scaledB = scaled.b();
    return solve(PairView(scaledA, scaledB, scaled.bInA()), [&scaled](auto x) { return scaled.restored(x); });
}

}  // namespace swept::inline SWEPT_PRECISION
