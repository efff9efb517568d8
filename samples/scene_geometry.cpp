#include "scene_geometry.h"

#include <algorithm>
#include <span>
#include <vector>

#include <swept/shapes/chain.h>
#include <swept/shapes/hull.h>
#include <swept/shapes/mass.h>

#include "scene_names.h"

namespace swept {
namespace {

Vec2 toVec2(DVec2 v) { return {v.x, v.y}; }

std::vector<Vec2> toVec2(std::span<const DVec2> points) {
    std::vector<Vec2> result;
    for (const DVec2 point : points) { result.push_back(toVec2(point)); }
    return result;
}

std::string elementOf(const char* list, std::size_t index) { return std::string(list) + "/" + std::to_string(index); }

std::optional<GeometryFault> equalEnds(const std::array<DVec2, 2>& points, const std::string& member) {
    if (!(points[0] == points[1])) { return std::nullopt; }
    return GeometryFault{member + "/1", "must differ from the first point " + textOf(points[0])};
}

std::optional<GeometryFault> fault(const BoxGeometry&) { return std::nullopt; }
std::optional<GeometryFault> fault(const CircleGeometry&) { return std::nullopt; }
std::optional<GeometryFault> fault(const CapsuleGeometry& capsule) { return equalEnds(capsule.points, "/points"); }
std::optional<GeometryFault> fault(const SegmentGeometry& segment) { return equalEnds(segment.points, ""); }

std::optional<GeometryFault> fault(const PolygonGeometry& polygon) {
    const std::size_t count = polygon.points.size();
    if (count < 3 || count > kMaxPolygonVertices) {
        return GeometryFault{"", "a polygon has 3 to " + std::to_string(kMaxPolygonVertices) +
                                     " points, this one has " + std::to_string(count)};
    }
    for (std::size_t i = 1; i < count; ++i) {
        const auto before = polygon.points.begin() + static_cast<std::ptrdiff_t>(i);
        const auto twin = std::find(polygon.points.begin(), before, polygon.points[i]);
        if (twin != before) {
            return GeometryFault{elementOf("", i), textOf(polygon.points[i]) + " repeats point " +
                                                       std::to_string(twin - polygon.points.begin())};
        }
    }
    const Result<Polygon> hull = convexHull(toVec2(polygon.points));
    if (hull.status().code == StatusCode::degenerate) {
        return GeometryFault{"", "the points lie on a line, the polygon has no area"};
    }
    if (!hull.ok()) { return GeometryFault{"", std::string("the hull of the points ") + describe(hull.status().code)}; }
    const std::span<const Vec2> vertices = hull.value().points();
    for (std::size_t i = 0; i < count; ++i) {
        if (std::find(vertices.begin(), vertices.end(), toVec2(polygon.points[i])) == vertices.end()) {
            return GeometryFault{elementOf("", i),
                                 textOf(polygon.points[i]) + " is no vertex of the convex hull of the points"};
        }
    }
    return std::nullopt;
}

std::optional<GeometryFault> faultOfNeighbours(const ChainGeometry& chain) {
    if (chain.loop && (chain.before || chain.after)) {
        return GeometryFault{chain.before ? "/before" : "/after", "a loop has no ends that could go on"};
    }
    if (chain.before == chain.points.front()) {
        return GeometryFault{"/before", textOf(*chain.before) + " repeats the first point"};
    }
    if (chain.after == chain.points.back()) {
        return GeometryFault{"/after", textOf(*chain.after) + " repeats the last point"};
    }
    return std::nullopt;
}

std::optional<GeometryFault> fault(const ChainGeometry& chain) {
    const std::size_t count = chain.points.size();
    const std::size_t needed = chain.loop ? 3 : 2;
    if (count < needed) {
        return GeometryFault{"/points", std::string(chain.loop ? "a loop" : "a chain") + " needs at least " +
                                            std::to_string(needed) + " points, this one has " + std::to_string(count)};
    }
    for (std::size_t i = 1; i < count; ++i) {
        if (chain.points[i] == chain.points[i - 1]) {
            return GeometryFault{elementOf("/points", i), textOf(chain.points[i]) + " repeats the point before it"};
        }
    }
    if (chain.loop && chain.points.front() == chain.points.back()) {
        return GeometryFault{elementOf("/points", count - 1),
                             textOf(chain.points.back()) + " repeats the first point; a loop closes by itself"};
    }
    const std::size_t segments = chain.loop ? count : count - 1;
    if (!chain.surfaces.empty() && chain.surfaces.size() != segments) {
        return GeometryFault{"/surfaces", "there must be one for each segment, " + std::to_string(segments) + ", not " +
                                              std::to_string(chain.surfaces.size())};
    }
    return faultOfNeighbours(chain);
}

Result<Polygon> polygonOf(const BoxGeometry& box, double radius) {
    return makeBox(toVec2(box.half), toVec2(box.center), box.angle, radius);
}
Result<Polygon> polygonOf(const CircleGeometry& circle, double) {
    return makeCircle(toVec2(circle.center), circle.radius);
}
Result<Polygon> polygonOf(const CapsuleGeometry& capsule, double) {
    return makeCapsule(toVec2(capsule.points[0]), toVec2(capsule.points[1]), capsule.radius);
}
Result<Polygon> polygonOf(const SegmentGeometry& segment, double radius) {
    return makeSegment(toVec2(segment.points[0]), toVec2(segment.points[1]), radius);
}
Result<Polygon> polygonOf(const PolygonGeometry& polygon, double radius) {
    return convexHull(toVec2(polygon.points), radius);
}
Result<Polygon> polygonOf(const ChainGeometry&, double) { return Status{StatusCode::degenerate, "chain"}; }

}  // namespace

std::optional<GeometryFault> geometryFault(const Geometry& geometry) {
    return std::visit([](const auto& alternative) { return fault(alternative); }, geometry);
}

std::vector<Polygon> piecesOf(const ShapeDescription& shape) {
    std::vector<Polygon> pieces;
    if (const auto* chain = std::get_if<ChainGeometry>(&shape.geometry)) {
        const std::vector<Vec2> points = toVec2(chain->points);
        const int count = chainSegmentCount(static_cast<int>(points.size()), chain->loop);
        for (int i = 0; i < count; ++i) {
            pieces.push_back(polygonOf(chainSegment(points, chain->loop, shape.radius, i)));
        }
        return pieces;
    }
    const auto polygon =
        std::visit([&](const auto& geometry) { return polygonOf(geometry, shape.radius); }, shape.geometry);
    if (polygon.ok()) { pieces.push_back(polygon.value()); }
    return pieces;
}

MassAndInertia massOfShapes(const BodyDescription& body) {
    std::vector<MassProperties> parts;
    for (const ShapeDescription& shape : body.shapes) {
        const auto polygon =
            std::visit([&](const auto& geometry) { return polygonOf(geometry, shape.radius); }, shape.geometry);
        if (polygon.ok()) { parts.push_back(massOf(polygon.value(), shape.density)); }
    }
    const MassProperties sum = combine(parts);
    return {sum.mass, sum.inertia};
}

}  // namespace swept
