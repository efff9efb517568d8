#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include <swept/shapes/distance.h>

#include "shape_families.h"

/// Random pairs that are hard for a distance algorithm, and their separation by brute force in long double.

namespace swept::test {

struct PairCase {
    Polygon a;
    Polygon b;
    Transform bInA;
};

inline std::ostream& operator<<(std::ostream& out, const PairCase& c) {
    return out << "A: " << c.a << "\nB: " << c.b << "\nat " << c.bInA.translation << " turned by "
               << Vec2{c.bInA.rotation.c, c.bInA.rotation.s};
}

/// The vertices of B in the frame of A, for the pose exactly as its numbers say.
inline std::vector<Point> placed(const Polygon& polygon, const Transform& pose) {
    const long double c = exact(pose.rotation.c);
    const long double s = exact(pose.rotation.s);
    std::vector<Point> points;
    for (const Point v : exactPoints(polygon)) {
        points.push_back(Point{c * v.x - s * v.y, s * v.x + c * v.y} + exact(pose.translation));
    }
    return points;
}

inline long double distanceToSegment(Point p, Point a, Point b) {
    const Point edge = b - a;
    const Point offset = p - a;
    const long double size = dot(edge, edge);
    const long double along = dot(offset, edge);
    if (!(along > 0)) { return length(offset); }
    if (along >= size) { return length(p - b); }
    return std::fabs(cross(edge, offset)) / std::sqrt(size);
}

/// Distance to the outline of a polygon (of a point or a segment: to it).
inline long double distanceToOutline(const std::vector<Point>& v, Point p) {
    long double nearest = length(p - v[0]);
    for (std::size_t i = 0; i < v.size(); ++i) {
        nearest = std::min(nearest, distanceToSegment(p, v[i], v[(i + 1) % v.size()]));
    }
    return nearest;
}

/// Largest separation along the outward edge normals of `v`.
inline long double faceSeparation(const std::vector<Point>& v, const std::vector<Point>& other) {
    long double best = -std::numeric_limits<long double>::infinity();
    for (std::size_t i = 0; v.size() > 1 && i < v.size(); ++i) {
        const Point edge = v[(i + 1) % v.size()] - v[i];
        const Point normal = (1 / length(edge)) * Point{edge.y, -edge.x};
        long double lowest = std::numeric_limits<long double>::infinity();
        for (const Point q : other) { lowest = std::min(lowest, dot(normal, q - v[i])); }
        best = std::max(best, lowest);
    }
    return best;
}

/// Signed separation of the cores: every vertex against every edge; where none is apart, the least penetration over all
/// edge normals. Segments and points have no inside: there, crossing is the only overlap.
inline long double coreSeparation(const std::vector<Point>& a, const std::vector<Point>& b) {
    long double nearest = std::numeric_limits<long double>::infinity();
    for (const Point p : a) { nearest = std::min(nearest, distanceToOutline(b, p)); }
    for (const Point p : b) { nearest = std::min(nearest, distanceToOutline(a, p)); }
    if (a.size() < 2 && b.size() < 2) { return nearest; }
    long double sides = std::max(faceSeparation(a, b), faceSeparation(b, a));
    if (a.size() <= 2 && b.size() <= 2) {  // on one line, only the ends can separate
        for (const std::vector<Point>* v : {&a, &b}) {
            if (v->size() < 2) { continue; }
            const Point edge = (*v)[1] - (*v)[0];
            const Point along = (1 / length(edge)) * edge;
            const auto range = [&along](const std::vector<Point>& points) {
                const long double first = dot(along, points.front());
                const long double last = dot(along, points.back());
                return std::pair(std::min(first, last), std::max(first, last));
            };
            const auto [lowA, highA] = range(a);
            const auto [lowB, highB] = range(b);
            sides = std::max(sides, std::max(lowB - highA, lowA - highB));
        }
    }
    return sides < 0 ? sides : nearest;
}

inline long double radiusAboutOrigin(const Polygon& polygon) {
    long double most = 0;
    for (const Point v : exactPoints(polygon)) { most = std::max(most, length(v)); }
    return most;
}

/// The length to which errors are compared: both sizes and the distance.
inline long double scaleOf(const PairCase& c, long double separation) {
    return radiusAboutOrigin(c.a) + radiusAboutOrigin(c.b) + std::fabs(separation);
}

/// The promise of distance.h, in units of eps × (sizes + distance).
inline constexpr long double kErrorBound = 8;

struct ShapeRecipe {
    double size = 1;
    double flatness = 1;   ///< ratio of the ellipse that the vertices lie on
    double shortEdge = 0;  ///< angle between the first two vertices, radians; 0: random
    int count = 0;         ///< 0: random, 1 to 8
    double radius = 0;
};

/// A segment where the recipe cannot be had (near the ends of the range of `Real`).
inline Polygon cook(Random& random, const ShapeRecipe& recipe) {
    for (int attempt = 0;; ++attempt) {
        const int wanted = recipe.count > 0 ? recipe.count : random.integer(1, kMaxPolygonVertices);
        const int count = attempt < 100 ? wanted : 2;
        std::vector<double> angles;
        for (int i = 0; i < count; ++i) { angles.push_back(random.range(0, 6.283)); }
        if (recipe.shortEdge > 0 && count > 2) { angles[1] = angles[0] + recipe.shortEdge; }
        std::sort(angles.begin(), angles.end());
        const double tilt = random.range(0, 6.283);
        std::vector<Vec2> v;
        for (const double angle : angles) {
            const double x = recipe.size * std::cos(angle);
            const double y = recipe.size * recipe.flatness * std::sin(angle);
            v.push_back({real(x * std::cos(tilt) - y * std::sin(tilt)), real(x * std::sin(tilt) + y * std::cos(tilt))});
        }
        const double radius = recipe.radius * recipe.size;
        if (count == 1) {
            Polygon point = makeCircle(v[0], real(recipe.size)).value();
            point.radius = real(radius);
            return point;
        }
        const Result<Polygon> made = count == 2 ? makeSegment(v[0], v[1], real(radius)) : makePolygon(v, real(radius));
        if (made.ok()) { return made.value(); }
    }
}

/// 2ᵏ times its size.
inline Polygon scaled(Polygon p, int k) {
    for (Vec2& v : p.vertices) { v = {std::ldexp(v.x, k), std::ldexp(v.y, k)}; }
    p.radius = std::ldexp(p.radius, k);
    return p;
}

inline Transform randomPose(Random& random, double farthest) {
    const double reach = random.range(0, farthest);
    const double direction = random.chance(0.2) ? 0 : random.range(0, 6.283);
    return {{real(reach * std::cos(direction)), real(reach * std::sin(direction))},
            rotationFromAngle(random.range(-3.2, 3.2))};
}

/// 10 to a power between −most and −least.
inline double tiny(Random& random, double least, double most) { return std::pow(10.0, -random.range(least, most)); }

enum class PairFamily {
    generic,
    rounded,
    sliver,        ///< as thin as 1 : 10⁶
    shortEdge,     ///< an edge of 10⁻⁶ of the size
    tinyAndHuge,   ///< 10⁻⁴ against 10⁴
    parallel,      ///< turned by quarters, or by next to nothing
    touching,      ///< moved into contact along the closest direction
    nearTouching,  ///< the same, apart or overlapping by 10⁻³ … 10⁻¹⁷ of the size
    duplicate,     ///< twice the same shape, often concentric
    segments,
    circles,
    farApart,  ///< up to 10⁴ sizes
};
inline constexpr std::array kPairFamilies = {PairFamily::generic,   PairFamily::rounded,      PairFamily::sliver,
                                             PairFamily::shortEdge, PairFamily::tinyAndHuge,  PairFamily::parallel,
                                             PairFamily::touching,  PairFamily::nearTouching, PairFamily::duplicate,
                                             PairFamily::segments,  PairFamily::circles,      PairFamily::farApart};
inline constexpr std::array kPairFamilyNames = {"generic",     "rounded",  "sliver",   "shortEdge",
                                                "tinyAndHuge", "parallel", "touching", "nearTouching",
                                                "duplicate",   "segments", "circles",  "farApart"};

template <class ParamInfo>  // of GoogleTest, whose header is not needed here otherwise
std::string familyName(const ParamInfo& family) {
    return kPairFamilyNames[static_cast<std::size_t>(family.param)];
}

/// Moves B along the closest direction until the cores are `gap` apart, as well as `Real` can say it.
inline void moveToGap(PairCase& c, double gap) {
    const Distance d = distance(c.a, c.b, c.bInA);
    const double move = gap - static_cast<double>(d.coreDistance);
    c.bInA.translation = toReal(toDouble(c.bInA.translation) + move * toDouble(d.normal));
}

inline PairCase makePair(PairFamily family, std::uint64_t seed) {
    Random random(seed * 64 + static_cast<std::uint64_t>(family));
    ShapeRecipe a;
    ShapeRecipe b;
    double reach = 4;
    switch (family) {
        case PairFamily::rounded:
            a.radius = random.range(0, 0.5);
            b.radius = random.range(0, 0.5);
            break;
        case PairFamily::sliver:
            a.flatness = tiny(random, 0, 6);
            b.flatness = tiny(random, 0, 6);
            break;
        case PairFamily::shortEdge:
            a.shortEdge = b.shortEdge = 1e-6;
            a.count = random.integer(3, 8);
            b.count = random.integer(3, 8);
            break;
        case PairFamily::tinyAndHuge:
            a.size = 1e-4;
            b.size = 1e4;
            if (random.chance(0.5)) { std::swap(a, b); }
            reach = 2e4;
            break;
        case PairFamily::segments:
            a.count = b.count = 2;
            break;
        case PairFamily::circles:
            a.count = 1;
            a.radius = random.range(0.1, 1);
            b.count = random.chance(0.5) ? 1 : 0;
            b.radius = random.range(0.1, 1);
            break;
        case PairFamily::farApart:
            reach = 2 * std::pow(10.0, random.range(0, 4));
            break;
        default:
            break;
    }
    PairCase c{cook(random, a), cook(random, b), randomPose(random, reach)};
    switch (family) {
        case PairFamily::parallel:
        case PairFamily::duplicate: {
            const double quarter = 1.5707963267948966 * random.integer(0, 3);
            const double turn = random.chance(0.5) ? 0 : random.sign() * tiny(random, 1, 16);
            c.bInA.rotation = rotationFromAngle(quarter + turn);
            if (family == PairFamily::parallel) { break; }
            c.b = c.a;
            const double shrink = random.chance(0.2) ? 0 : tiny(random, 0, 16);
            c.bInA.translation = real(shrink) * c.bInA.translation;
            break;
        }
        case PairFamily::touching:
            moveToGap(c, 0);
            break;
        case PairFamily::nearTouching:
            moveToGap(c, random.sign() * tiny(random, 3, 17));
            break;
        default:
            break;
    }
    return c;
}

}  // namespace swept::test
