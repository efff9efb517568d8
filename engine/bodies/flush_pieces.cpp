#include "flush_pieces.h"

#include <algorithm>
#include <cmath>

#include "../../shapes/aabb.h"
#include "../state/tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Sine up to which two faces look the same way.
constexpr Real kSameWay = Real(1) / 1024;

struct Interval {
    Real low = 0;
    Real high = 0;
};

/// Of the ends of a face, along its line.
Interval extentAlong(const Polygon& polygon, int face, Vec2 tangent) {
    const auto first = static_cast<std::size_t>(face);
    const std::size_t second = (first + 1) % static_cast<std::size_t>(polygon.count);
    const Real one = dot(polygon.vertices[first], tangent);
    const Real other = dot(polygon.vertices[second], tangent);
    return {std::min(one, other), std::max(one, other)};
}

/// @param slop  metres
bool areFlush(const Polygon& a, int faceA, const Polygon& b, int faceB, Real slop) {
    const Vec2 normal = a.normals[static_cast<std::size_t>(faceA)];
    const Vec2 other = b.normals[static_cast<std::size_t>(faceB)];
    if (!(dot(normal, other) > 0) || std::fabs(cross(normal, other)) > kSameWay) { return false; }
    const Vec2 apart = b.vertices[static_cast<std::size_t>(faceB)] - a.vertices[static_cast<std::size_t>(faceA)];
    if (std::fabs(dot(normal, apart) + b.radius - a.radius) > slop) { return false; }
    const Interval one = extentAlong(a, faceA, rightPerp(normal));
    const Interval two = extentAlong(b, faceB, rightPerp(normal));
    return one.low <= two.high + slop && two.low <= one.high + slop;
}

bool areFlush(const Shape& a, const Shape& b) {
    const Real slop = kTargetRatio * std::min(a.extent, b.extent);
    for (int i = 0; i < a.polygon.count; ++i) {
        for (int k = 0; k < b.polygon.count; ++k) {
            if (areFlush(a.polygon, i, b.polygon, k, slop)) { return true; }
        }
    }
    return false;
}

bool hasFaces(const Shape& shape) { return shape.polygon.count > 1 && !shape.def.sensor; }

Aabb boxOf(const Shape& shape) {
    Aabb box{shape.polygon.vertices[0], shape.polygon.vertices[0]};
    for (const Vec2 vertex : shape.polygon.points()) {
        box.lower = {std::min(box.lower.x, vertex.x), std::min(box.lower.y, vertex.y)};
        box.upper = {std::max(box.upper.x, vertex.x), std::max(box.upper.y, vertex.y)};
    }
    return box;
}

bool overlapWithin(const Aabb& a, const Aabb& b, Real slop) {
    return a.lower.x <= b.upper.x + slop && b.lower.x <= a.upper.x + slop && a.lower.y <= b.upper.y + slop &&
           b.lower.y <= a.upper.y + slop;
}

}  // namespace

std::vector<std::uint32_t> markFlushPieces(WorldState& world, std::uint32_t body, std::size_t first) {
    const std::vector<std::uint32_t>& all = world.bodies[body].shapes;
    std::vector<std::uint32_t> marked;
    for (std::size_t i = first; i < all.size(); ++i) {
        Shape& added = world.shapes[all[i]];
        if (!hasFaces(added)) { continue; }
        const Aabb box = boxOf(added);
        for (std::size_t k = 0; k < i; ++k) {
            Shape& other = world.shapes[all[k]];
            if (!hasFaces(other) || (added.isPiece && other.isPiece)) { continue; }
            if (!overlapWithin(box, boxOf(other), kTargetRatio * added.extent) || !areFlush(added, other)) { continue; }
            if (!other.isPiece && k < first) { marked.push_back(all[k]); }
            added.isPiece = other.isPiece = true;
            world.anyPieces = true;
        }
    }
    return marked;
}

}  // namespace swept::inline SWEPT_PRECISION
