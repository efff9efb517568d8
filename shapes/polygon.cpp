#include "polygon.h"

#include <algorithm>
#include <cmath>

#include "convexity.h"
#include "lanes.h"
#include "rescaling.h"
#include "rounding.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

Status checkRadius(Real radius) {
    if (!isFinite(radius)) { return {StatusCode::notFinite, "radius"}; }
    if (radius < 0) { return {StatusCode::negative, "radius"}; }
    return Status::success();
}

void setNormals(Polygon& polygon) {
    for (int i = 0; i < polygon.count && polygon.count > 1; ++i) {
        const auto at = static_cast<std::size_t>(i);
        polygon.normals[at] =
            edgeNormal(polygon.vertices[at], polygon.vertices[static_cast<std::size_t>(polygon.next(i))]);
    }
}

/// Vertices and edges are finite, and no two neighbours coincide; more than two turn left, once around.
Status checkOutline(const Polygon& polygon, const char* field) {
    for (int i = 0; i < polygon.count; ++i) {
        const Vec2 p = polygon.vertices[static_cast<std::size_t>(i)];
        const Vec2 q = polygon.vertices[static_cast<std::size_t>(polygon.next(i))];
        if (!isFinite(p) || !isFinite(q - p)) { return {StatusCode::notFinite, field}; }
    }
    if (polygon.count == 2 && polygon.vertices[0] == polygon.vertices[1]) { return {StatusCode::degenerate, field}; }
    if (polygon.count > 2) {
        const StatusCode code = judgeConvexity(polygon.points());
        if (code != StatusCode::ok) { return {code, field}; }
    }
    return Status::success();
}

/// Vertices of a box as offsets from its centre, counter-clockwise from the lower left one.
std::array<DVec2, 4> boxCorners(Vec2 half, double angle) {
    const SinCos turn = sinCos(angle);
    const DVec2 along = static_cast<double>(half.x) * DVec2{turn.cos, turn.sin};
    const DVec2 across = static_cast<double>(half.y) * DVec2{-turn.sin, turn.cos};
    return {-along - across, along - across, along + across, across - along};
}

// Unit normals of the makers are within 3 roundings of the exact ones; a hand-made one may be computed otherwise.
constexpr Real kNormalError = 8 * kEpsilon;

Status checkNormals(const Polygon& polygon) {
    for (int i = 0; i < polygon.count && polygon.count > 1; ++i) {
        const auto at = static_cast<std::size_t>(i);
        const Vec2 given = polygon.normals[at];
        if (!isFinite(given)) { return {StatusCode::notFinite, "normals"}; }
        const Vec2 wanted =
            edgeNormal(polygon.vertices[at], polygon.vertices[static_cast<std::size_t>(polygon.next(i))]);
        const Vec2 difference = given - wanted;
        if (std::fmax(std::fabs(difference.x), std::fabs(difference.y)) > kNormalError) {
            return {StatusCode::outOfRange, "normals"};
        }
    }
    return Status::success();
}

}  // namespace

Result<Polygon> makeCircle(Vec2 center, Real radius) {
    if (!isFinite(center)) { return Status{StatusCode::notFinite, "center"}; }
    if (const Status status = checkRadius(radius); !status.ok()) { return status; }
    if (radius == 0) { return Status{StatusCode::degenerate, "radius"}; }
    Polygon polygon;
    polygon.vertices[0] = center;
    polygon.radius = radius;
    polygon.count = 1;
    return polygon;
}

Result<Polygon> makeCapsule(Vec2 p, Vec2 q, Real radius) {
    if (radius == 0) { return Status{StatusCode::degenerate, "radius"}; }
    return makeSegment(p, q, radius);
}

Result<Polygon> makeSegment(Vec2 p, Vec2 q, Real radius) {
    if (const Status status = checkRadius(radius); !status.ok()) { return status; }
    Polygon polygon;
    polygon.vertices[0] = p;
    polygon.vertices[1] = q;
    polygon.radius = radius;
    polygon.count = 2;
    if (const Status status = checkOutline(polygon, "points"); !status.ok()) { return status; }
    setNormals(polygon);
    return polygon;
}

Result<Polygon> makeBox(Vec2 half, Vec2 center, double angle, Real radius) {
    if (!isFinite(half)) { return Status{StatusCode::notFinite, "half"}; }
    if (half.x < 0 || half.y < 0) { return Status{StatusCode::negative, "half"}; }
    if (half.x == 0 || half.y == 0) { return Status{StatusCode::degenerate, "half"}; }
    if (!isFinite(center)) { return Status{StatusCode::notFinite, "center"}; }
    if (!std::isfinite(angle)) { return Status{StatusCode::notFinite, "angle"}; }
    if (const Status status = checkRadius(radius); !status.ok()) { return status; }
    Polygon polygon;
    for (const DVec2 corner : boxCorners(half, angle)) {
        polygon.vertices[static_cast<std::size_t>(polygon.count++)] = toReal(toDouble(center) + corner);
    }
    polygon.radius = radius;
    Status outline = checkOutline(polygon, "half");
    // Far from the origin the vertices of a small box round to fewer points, or to a shape that is none.
    if (outline.code == StatusCode::notConvex) { outline.code = StatusCode::degenerate; }
    if (!outline.ok()) { return outline; }
    setNormals(polygon);
    return polygon;
}

Result<Polygon> makePolygon(std::span<const Vec2> vertices, Real radius) {
    if (vertices.size() < 3) { return Status{StatusCode::tooFewVertices, "vertices"}; }
    if (vertices.size() > static_cast<std::size_t>(kMaxPolygonVertices)) {
        return Status{StatusCode::tooManyVertices, "vertices"};
    }
    if (const Status status = checkRadius(radius); !status.ok()) { return status; }
    Polygon polygon;
    for (const Vec2 vertex : vertices) { polygon.vertices[static_cast<std::size_t>(polygon.count++)] = vertex; }
    polygon.radius = radius;
    if (const Status status = checkOutline(polygon, "vertices"); !status.ok()) { return status; }
    setNormals(polygon);
    return polygon;
}

Status validate(const Polygon& polygon) {
    if (polygon.count < 1) { return {StatusCode::tooFewVertices, "count"}; }
    if (polygon.count > kMaxPolygonVertices) { return {StatusCode::tooManyVertices, "count"}; }
    if (const Status status = checkRadius(polygon.radius); !status.ok()) { return status; }
    if (polygon.count == 1 && polygon.radius == 0) { return {StatusCode::degenerate, "radius"}; }
    if (const Status status = checkOutline(polygon, "vertices"); !status.ok()) { return status; }
    return checkNormals(polygon);
}

namespace {

/// Smallest width of a core of three or more vertices.
double widthOf(const Polygon& polygon) {
    // The smallest width of a convex polygon is taken with one edge flush (Toussaint 1983).
    double smallest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < polygon.count; ++i) {
        const DVec2 start = toDouble(polygon.vertices[static_cast<std::size_t>(i)]);
        const DVec2 edge = toDouble(polygon.vertices[static_cast<std::size_t>(polygon.next(i))]) - start;
        double farthest = 0;
        for (const Vec2 v : polygon.points()) { farthest = std::fmax(farthest, cross(edge, toDouble(v) - start)); }
        smallest = std::fmin(smallest, farthest / length(edge));
    }
    return smallest;
}

/// Where products leave the range of double.
double widthOfRescaled(const Polygon& polygon) {
    const int exponent = exponentOf(largestOf(polygon.points()));
    Polygon near = polygon;
    for (Vec2& v : near.vertices) { v = rescaled(v, -exponent); }
    constexpr double kMost = std::numeric_limits<double>::max();
    return std::fmin(std::ldexp(widthOf(near), exponent), kMost);
}

}  // namespace

Real extentOf(const Polygon& polygon) {
    const double rounding = 2 * static_cast<double>(polygon.radius);
    if (polygon.count == 1) { return static_cast<Real>(rounding); }
    if (polygon.count == 2) {
        const Vec2 edge = polygon.vertices[1] - polygon.vertices[0];
        if (rounding > 0) { return static_cast<Real>(rounding); }
        return kProductsMayOverflow && !productsFit(largestOf(edge))
                   ? normalized(edge).length
                   : static_cast<Real>(length(toDouble(polygon.vertices[1]) - toDouble(polygon.vertices[0])));
    }
    double width = widthOf(polygon);
    if (kProductsMayOverflow && !productsFit(width)) { width = widthOfRescaled(polygon); }
    return static_cast<Real>(width + rounding);
}

Aabb boundsOf(const Polygon& polygon, const WorldTransform& pose) { return boundsOf(polygon, pose, {}, 0); }

Aabb boundsOf(const Polygon& polygon, const WorldTransform& pose, DVec2 way, Real reach) {
    using Pair = LanesOf<double, 2>;  // both axes at once: boxes are made for all that moves, in each step
    const auto abs = [](Pair v) { return largerOf(-v, v); };
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto c = static_cast<double>(pose.rotation.c);
    const auto s = static_cast<double>(pose.rotation.s);
    const Pair alongX{c, s};
    const Pair alongY{-s, c};
    Pair lower{kInfinity, kInfinity};
    Pair upper{-kInfinity, -kInfinity};
    Pair widest{};
    for (const Vec2 vertex : polygon.points()) {
        const DVec2 v = toDouble(vertex);
        const Pair turned = alongX * v.x + alongY * v.y;
        lower = smallerOf(turned, lower);
        upper = largerOf(turned, upper);
        const Pair away = abs(Pair{v.x, v.y});
        widest = largerOf(away, widest);
    }
    // Two roundings in `Real` for callers who turn the vertices in `Real`, and what the sums below may lose in double.
    constexpr double kTurnError = 2 * static_cast<double>(kEpsilon);
    constexpr double kSumError = 4 * std::numeric_limits<double>::epsilon();
    const double size = widest[0] + widest[1];
    const double around = static_cast<double>(polygon.radius) + static_cast<double>(reach);
    const Pair from{pose.position.x, pose.position.y};
    const Pair along{way.x, way.y};
    const Pair to = from + along;
    const Pair margin = around + kTurnError * size + kSumError * (abs(from) + abs(along) + (size + around));
    Pair low = smallerOf(to, from) + (lower - margin);
    Pair high = largerOf(to, from) + (upper + margin);
    // Outward by what rounding to `Real` may take away, so that nobody need ask which way it went.
    if constexpr (sizeof(Real) < sizeof(double)) {
        constexpr double kRealError = static_cast<double>(kEpsilon);
        constexpr double kLeast = static_cast<double>(std::numeric_limits<Real>::denorm_min());
        low = low - (kRealError * abs(low) + kLeast);
        high = high + (kRealError * abs(high) + kLeast);
    }
    constexpr double kMost = static_cast<double>(std::numeric_limits<Real>::max());
    const Pair most{kMost, kMost};
    low = largerOf(-most, smallerOf(most, low));
    high = largerOf(-most, smallerOf(most, high));
    return {{static_cast<Real>(low[0]), static_cast<Real>(low[1])},
            {static_cast<Real>(high[0]), static_cast<Real>(high[1])}};
}

Real radiusAbout(const Polygon& polygon, Vec2 center) {
    double farthest = 0;
    for (const Vec2 v : polygon.points()) { farthest = std::max(farthest, length(toDouble(v) - toDouble(center))); }
    // Difference, square, sum, root and the last sum lose less than 4 roundings of ½ eps.
    constexpr double kRoundUp = 1 + 4 * std::numeric_limits<double>::epsilon();
    return roundedUp((farthest + static_cast<double>(polygon.radius)) * (farthest > 0 ? kRoundUp : 1.0));
}

int supportIndex(const Polygon& polygon, Vec2 direction) {
    int best = 0;
    Real farthest = dot(polygon.vertices[0], direction);
    for (int i = 1; i < polygon.count; ++i) {
        const Real along = dot(polygon.vertices[static_cast<std::size_t>(i)], direction);
        if (along > farthest) {
            farthest = along;
            best = i;
        }
    }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
