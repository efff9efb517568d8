#include "convexity.h"

#include <array>
#include <cmath>

#include "rescaling.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Whether all points lie within rounding of the line through the first one and the one farthest from it.
bool onOneLine(std::span<const Vec2> points) {
    const DVec2 origin = toDouble(points.front());
    DVec2 farthest;
    for (const Vec2 point : points) {
        const DVec2 offset = toDouble(point) - origin;
        if (dot(offset, offset) > dot(farthest, farthest)) { farthest = offset; }
    }
    const double limit = kSmallestTurn * dot(farthest, farthest);
    for (const Vec2 point : points) {
        if (std::fabs(cross(farthest, toDouble(point) - origin)) > limit) { return false; }
    }
    return true;
}

/// Directions of [0, π) against those of [π, 2π): a polygon that turns left once around changes between them twice, a
/// star more often.
bool pointsUp(DVec2 edge) { return edge.y > 0 || (edge.y == 0 && edge.x > 0); }

/// What is huge or tiny, near 1.
StatusCode judgeRescaled(std::span<const Vec2> vertices, double size) {
    std::array<Vec2, kMaxPolygonVertices> near;
    for (std::size_t i = 0; i < vertices.size(); ++i) { near[i] = rescaled(vertices[i], -exponentOf(size)); }
    return judgeConvexity(std::span(near).first(vertices.size()));
}

}  // namespace

double sizeOf(std::span<const Vec2> points) {
    if (points.empty()) { return 0; }
    Vec2 lower = points.front();
    Vec2 upper = points.front();
    for (const Vec2 point : points) {
        lower = min(lower, point);
        upper = max(upper, point);
    }
    const DVec2 sides = toDouble(upper) - toDouble(lower);
    return std::fmax(sides.x, sides.y);
}

double heightOver(Vec2 p, Vec2 q, Vec2 r) {
    const DVec2 chord = toDouble(r) - toDouble(p);
    const DVec2 in = toDouble(q) - toDouble(p);
    const DVec2 out = toDouble(r) - toDouble(q);
    const double area = cross(in, chord);
    if (area <= 0) { return 0; }
    if (dot(in, chord) <= 0) { return length(in); }
    if (dot(out, chord) <= 0) { return length(out); }
    return area / length(chord);
}

StatusCode judgeConvexity(std::span<const Vec2> vertices) {
    const std::size_t count = vertices.size();
    const auto edge = [&](std::size_t i) {
        return toDouble(vertices[(i + 1) % count]) - toDouble(vertices[i % count]);
    };
    int changes = 0;
    bool convex = true;
    for (std::size_t i = 0; i < count; ++i) {
        const DVec2 in = edge(i);
        const DVec2 out = edge(i + 1);
        convex = convex && cross(in, out) > kSmallestTurn * (length(in) * length(out));
        changes += pointsUp(in) != pointsUp(out) ? 1 : 0;
    }
    if (convex && changes == 2) { return StatusCode::ok; }
    if (kProductsMayOverflow) {
        const double size = largestOf(vertices);
        if (!productsFit(size) && size > 0) { return judgeRescaled(vertices, size); }
    }
    return onOneLine(vertices) ? StatusCode::degenerate : StatusCode::notConvex;
}

}  // namespace swept::inline SWEPT_PRECISION
