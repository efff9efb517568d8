#include "mass.h"

#include <cmath>
#include <numbers>

namespace swept::inline SWEPT_PRECISION {

namespace {

constexpr double kHalfTurn = std::numbers::pi;

constexpr DVec2 quarterTurned(DVec2 a) { return {a.y, -a.x}; }

/// Moments of an area about one origin; areas add up.
struct Moments {
    double area = 0;
    DVec2 first;        ///< ∫ r dA
    double second = 0;  ///< ∫ |r|² dA
};

/// Adds an area whose moments are known about its own origin, which stands at `offset`.
void add(Moments& sum, const Moments& part, DVec2 offset) {
    sum.area += part.area;
    sum.first += part.first + part.area * offset;
    sum.second += part.second + 2 * dot(offset, part.first) + part.area * dot(offset, offset);
}

/// Triangle (0, a, b), counter-clockwise.
Moments triangle(DVec2 a, DVec2 b) {
    const double area = 0.5 * cross(a, b);
    return {area, (area / 3) * (a + b), (area / 6) * (dot(a, a) + dot(a, b) + dot(b, b))};
}

/// Rectangle on the outer side of an edge from the origin.
Moments rectangle(DVec2 edge, double radius) {
    const double edgeLength = length(edge);
    const double area = edgeLength * radius;
    const DVec2 center = 0.5 * (edge + (radius / edgeLength) * quarterTurned(edge));
    return {area, area * center, (area / 3) * (edgeLength * edgeLength + radius * radius)};
}

/// Sector of a disk about the origin, between two unit vectors `angle` apart.
Moments sector(DVec2 from, DVec2 to, double angle, double radius) {
    const double cube = radius * radius * radius;
    return {0.5 * angle * radius * radius, (cube / 3) * quarterTurned(to - from), 0.25 * angle * cube * radius};
}

/// Vertex relative to the first one.
DVec2 cornerAt(const Polygon& polygon, int i) {
    return toDouble(polygon.vertices[static_cast<std::size_t>(i)]) - toDouble(polygon.vertices[0]);
}

/// What the radius adds at vertex i and at the edge behind it.
void addRounding(Moments& sum, const Polygon& polygon, int i) {
    const double radius = static_cast<double>(polygon.radius);
    const DVec2 vertex = cornerAt(polygon, i);
    const DVec2 in = vertex - cornerAt(polygon, polygon.previous(i));
    const DVec2 out = cornerAt(polygon, polygon.next(i)) - vertex;
    // The two edges of a segment are opposite; rounding must not turn π into −π.
    const double angle = polygon.count == 2 ? kHalfTurn : arcTangent2(cross(in, out), dot(in, out));
    const DVec2 from = (1 / length(in)) * quarterTurned(in);
    const DVec2 to = (1 / length(out)) * quarterTurned(out);
    add(sum, sector(from, to, angle, radius), vertex);
    add(sum, rectangle(out, radius), vertex);
}

Moments momentsOf(const Polygon& polygon) {
    const double radius = static_cast<double>(polygon.radius);
    if (polygon.count == 1) { return sector({1, 0}, {1, 0}, 2 * kHalfTurn, radius); }
    Moments sum;
    for (int i = 1; i + 1 < polygon.count; ++i) {
        add(sum, triangle(cornerAt(polygon, i), cornerAt(polygon, i + 1)), {});
    }
    for (int i = 0; i < polygon.count && radius > 0; ++i) { addRounding(sum, polygon, i); }
    return sum;
}

}  // namespace

MassProperties massOf(const Polygon& polygon, Real density) {
    const DVec2 origin = toDouble(polygon.vertices[0]);
    const Moments moments = momentsOf(polygon);
    if (!(moments.area > 0)) { return {0, origin + 0.5 * cornerAt(polygon, polygon.count - 1), 0}; }
    const DVec2 center = (1 / moments.area) * moments.first;
    const double perDensity = moments.second - moments.area * dot(center, center);
    const double weight = static_cast<double>(density);
    // What rounding has made less than 0 is 0; what overflowed on the way stays NaN.
    const MassProperties properties{weight * moments.area, origin + center, weight * (perDensity < 0 ? 0 : perDensity)};
    // What weighs nothing does so at any size.
    const bool isNumber = std::isfinite(properties.inertia) && isFinite(properties.center);
    return weight > 0 || isNumber ? properties : MassProperties{0, origin, 0};
}

bool isWeighable(const MassProperties& properties) {
    const bool resists = properties.inertia > 0 || (properties.mass == 0 && properties.inertia == 0);
    return resists && std::isfinite(properties.mass) && std::isfinite(properties.inertia);
}

MassProperties combine(std::span<const MassProperties> parts) {
    MassProperties sum;
    for (const MassProperties& part : parts) { sum.mass += part.mass; }
    if (!(sum.mass > 0)) { return {}; }
    const DVec2 origin = parts.front().center;  // near the parts, wherever the body frame is
    DVec2 first;
    for (const MassProperties& part : parts) { first += part.mass * (part.center - origin); }
    sum.center = origin + (1 / sum.mass) * first;
    for (const MassProperties& part : parts) {
        const DVec2 offset = part.center - sum.center;
        sum.inertia += part.inertia + part.mass * dot(offset, offset);
    }
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
