#include "bounding_circle.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// A centre, as offset from the first vertex, and the square of the radius that it needs.
struct Candidate {
    DVec2 center;
    double radiusSquared;
};

struct Points {
    std::array<DVec2, kMaxPolygonVertices> at{};  ///< relative to the first vertex
    int count = 0;
};

DVec2 at(const Points& points, int i) { return points.at[static_cast<std::size_t>(i)]; }

/// Keeps the better one. Every candidate holds all points by construction, so no tolerance decides anything.
void consider(const Points& points, DVec2 center, Candidate& best) {
    if (!isFinite(center)) { return; }  // three points on a line
    double needed = 0;
    for (int i = 0; i < points.count; ++i) {
        const DVec2 offset = at(points, i) - center;
        needed = std::fmax(needed, dot(offset, offset));
    }
    if (needed < best.radiusSquared) { best = {center, needed}; }
}

DVec2 circumcenter(DVec2 a, DVec2 b, DVec2 c) {
    const DVec2 ab = b - a;
    const DVec2 ac = c - a;
    const double scale = 0.5 / cross(ab, ac);
    const double bb = dot(ab, ab);
    const double cc = dot(ac, ac);
    return a + scale * DVec2{ac.y * bb - ab.y * cc, ab.x * cc - ac.x * bb};
}

}  // namespace

Circle boundingCircle(const Polygon& polygon) {
    const DVec2 origin = toDouble(polygon.vertices[0]);
    Points points;
    for (const Vec2 v : polygon.points()) {
        points.at[static_cast<std::size_t>(points.count++)] = toDouble(v) - origin;
    }

    Candidate best{{}, std::numeric_limits<double>::infinity()};
    consider(points, {}, best);
    for (int i = 0; i < points.count; ++i) {
        for (int j = i + 1; j < points.count; ++j) {
            consider(points, 0.5 * (at(points, i) + at(points, j)), best);
            for (int k = j + 1; k < points.count; ++k) {
                consider(points, circumcenter(at(points, i), at(points, j), at(points, k)), best);
            }
        }
    }
    const Vec2 center = toReal(origin + best.center);
    return {center, radiusAbout(polygon, center)};
}

}  // namespace swept::inline SWEPT_PRECISION
