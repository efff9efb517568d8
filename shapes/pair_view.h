#pragma once

#include "compiler.h"
#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Two polygons and their relative pose, read in double in both builds. The frame is that of A.
///
/// Why double: the products of GJK, of separating axes and of clipping lose what the inputs have in common. In double a
/// float pose is exact and those losses are far below one float rounding; double arithmetic costs the same as float in
/// scalar code, while the conversions cost a few nanoseconds a query.
struct PairView {
    const Polygon& a;
    const Polygon& b;
    DVec2 translation;
    double c;
    double s;

    PairView(const Polygon& shapeA, const Polygon& shapeB, const Transform& bInA)
        : a(shapeA),
          b(shapeB),
          translation(toDouble(bInA.translation)),
          c(static_cast<double>(bInA.rotation.c)),
          s(static_cast<double>(bInA.rotation.s)) {}

    /// Linear part of the pose and its transpose.
    DVec2 toA(DVec2 v) const { return {c * v.x - s * v.y, s * v.x + c * v.y}; }
    DVec2 toB(DVec2 v) const { return {c * v.x + s * v.y, c * v.y - s * v.x}; }

    DVec2 vertexA(int i) const { return toDouble(a.vertices[static_cast<std::size_t>(i)]); }
    DVec2 localB(int i) const { return toDouble(b.vertices[static_cast<std::size_t>(i)]); }
    DVec2 vertexB(int i) const { return toA(localB(i)) + translation; }
    /// Differences of the original vertices: their relative error is one rounding, as short as they may be.
    DVec2 spanA(int from, int to) const { return vertexA(to) - vertexA(from); }
    DVec2 spanB(int from, int to) const { return toA(localB(to) - localB(from)); }
    DVec2 edgeA(int i) const { return spanA(i, a.next(i)); }
    DVec2 edgeB(int i) const { return spanB(i, b.next(i)); }
    DVec2 normalA(int i) const { return toDouble(a.normals[static_cast<std::size_t>(i)]); }
    DVec2 localNormalB(int i) const { return toDouble(b.normals[static_cast<std::size_t>(i)]); }
    DVec2 normalB(int i) const { return toA(localNormalB(i)); }
};

/// What double resolves of a difference of coordinates, per unit of their sum: a rotated and translated vertex carries
/// about three half-units of rounding, the difference one more.
inline constexpr double kResolution = 2 * std::numeric_limits<double>::epsilon();

/// Number of edges with a side: none for a point, two for a segment.
constexpr int faceCount(const Polygon& p) { return p.count < 2 ? 0 : p.count; }

/// Sum of the magnitudes of the coordinates: a cheap length, at most √2 times the Euclidean one.
inline double sumNorm(DVec2 v) { return std::fabs(v.x) + std::fabs(v.y); }

/// Turned by +90° and −90°.
constexpr DVec2 rightPerp(DVec2 v) { return {v.y, -v.x}; }

/// `v` divided by its length. @pre v is not zero and its square neither overflows nor underflows.
inline DVec2 unitOf(DVec2 v) { return (1 / length(v)) * v; }

/// Unit normal of a counter-clockwise edge; the stored one where the edge's square underflows.
inline DVec2 edgeNormal(DVec2 edge, DVec2 stored) {
    return dot(edge, edge) >= (std::numeric_limits<double>::min)() ? unitOf(rightPerp(edge)) : stored;
}

/// Nearest `Real`; magnitudes beyond its range become its largest finite value.
inline Real clampedReal(double x) {
    constexpr double kLargest = static_cast<double>((std::numeric_limits<Real>::max)());
    return static_cast<Real>(x > kLargest ? kLargest : (x < -kLargest ? -kLargest : x));
}
inline Vec2 clampedReal(DVec2 v) { return {clampedReal(v.x), clampedReal(v.y)}; }

/// Index of the vertex with the largest (sign +1) or smallest (sign −1) value of dot(direction, vertex); the lowest
/// index on a tie. `direction` is in the frame of the polygon.
template <int sign>
SWEPT_FORCE_INLINE int extremeVertex(const Polygon& p, DVec2 direction) {
    int best = 0;
    double bestDot = sign * dot(direction, toDouble(p.vertices[0]));
    for (int i = 1; i < p.count; ++i) {
        const double d = sign * dot(direction, toDouble(p.vertices[static_cast<std::size_t>(i)]));
        best = d > bestDot ? i : best;
        bestDot = d > bestDot ? d : bestDot;
    }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
