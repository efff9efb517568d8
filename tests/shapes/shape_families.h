#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <vector>

#include <swept/shapes/hull.h>
#include <swept/shapes/polygon.h>

#include "../support/random.h"

/// Random shapes for the property tests of this folder, and long double twins of their coordinates.

namespace swept::test {

/// A point of the oracles. They share no arithmetic with the library.
struct Point {
    long double x = 0;
    long double y = 0;
};

inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator*(long double s, Point a) { return {s * a.x, s * a.y}; }
inline long double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
inline long double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline long double length(Point a) { return std::sqrt(dot(a, a)); }
inline Point exact(Vec2 a) { return {static_cast<long double>(a.x), static_cast<long double>(a.y)}; }
inline Point exact(DVec2 a) { return {static_cast<long double>(a.x), static_cast<long double>(a.y)}; }
inline long double exact(Real a) { return static_cast<long double>(a); }

inline constexpr long double kEps = static_cast<long double>(std::numeric_limits<Real>::epsilon());

inline Real real(double x) { return static_cast<Real>(x); }
inline Vec2 randomVec(Random& random, double low, double high) {
    const double x = random.range(low, high);
    return {real(x), real(random.range(low, high))};
}

inline std::vector<Point> exactPoints(const Polygon& polygon) {
    std::vector<Point> points;
    for (const Vec2 v : polygon.points()) { points.push_back(exact(v)); }
    return points;
}

/// Distance from a point to the polygon without radius; inside, minus the distance to the outline.
inline long double signedDistanceToCore(const Polygon& polygon, Point point) {
    const std::vector<Point> v = exactPoints(polygon);
    bool inside = v.size() > 2;
    long double nearest = length(point - v[0]);
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Point edge = v[(i + 1) % v.size()] - v[i];
        const Point offset = point - v[i];
        inside = inside && cross(edge, offset) >= 0;
        const long double size = dot(edge, edge);
        const long double t = size > 0 ? std::clamp(dot(offset, edge) / size, 0.0L, 1.0L) : 0.0L;
        nearest = std::min(nearest, length(offset - t * edge));
    }
    return inside ? -nearest : nearest;
}

/// 0 inside.
inline long double distanceToCore(const Polygon& polygon, Point point) {
    return std::max(signedDistanceToCore(polygon, point), 0.0L);
}

/// 3 to 8 vertices on an ellipse, counter-clockwise, about 1 m, anywhere within `offset` metres of the origin.
inline Polygon randomPolygon(Random& random, double radius, double offset = 0) {
    for (;;) {
        const int count = random.integer(3, kMaxPolygonVertices);
        std::vector<double> angles(static_cast<std::size_t>(count));
        for (double& angle : angles) { angle = random.range(0, 6.283); }
        std::sort(angles.begin(), angles.end());
        const double flat = random.range(0.05, 1);
        const double tilt = random.range(0, 6.283);
        const Vec2 center = randomVec(random, -offset, offset);
        std::vector<Vec2> vertices;
        for (const double angle : angles) {
            const double x = std::cos(angle);
            const double y = flat * std::sin(angle);
            vertices.push_back({real(static_cast<double>(center.x) + x * std::cos(tilt) - y * std::sin(tilt)),
                                real(static_cast<double>(center.y) + x * std::sin(tilt) + y * std::cos(tilt))});
        }
        const Result<Polygon> polygon = makePolygon(vertices, real(radius));
        if (polygon.ok()) { return polygon.value(); }
    }
}

/// Any shape: circle, capsule, segment, polygon, rounded polygon.
inline Polygon randomShape(Random& random, double offset = 0) {
    const int kind = random.integer(0, 5);
    const Vec2 p = randomVec(random, -offset - 1, offset + 1);
    const Vec2 q = p + randomVec(random, 0.1, 1);
    const double radius = random.range(0.01, 1);
    switch (kind) {
        case 0:
            return makeCircle(p, real(radius)).value();
        case 1:
            return makeCapsule(p, q, real(radius)).value();
        case 2:
            return makeSegment(p, q).value();
        case 3:
            return randomPolygon(random, 0, offset);
        default:
            return randomPolygon(random, radius, offset);
    }
}

}  // namespace swept::test

namespace swept::inline SWEPT_PRECISION {

inline std::ostream& operator<<(std::ostream& out, const Vec2& v) {
    const auto digits = out.precision(std::numeric_limits<Real>::max_digits10);
    out << '(' << v.x << ", " << v.y << ')';
    out.precision(digits);
    return out;
}

inline std::ostream& operator<<(std::ostream& out, const Polygon& polygon) {
    for (const Vec2 v : polygon.points()) { out << v << ' '; }
    return out << "radius " << polygon.radius;
}

}  // namespace swept::inline SWEPT_PRECISION
