#include "chain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Status validateNeighbour(const std::optional<Vec2>& neighbour, Vec2 end, bool loop, const char* field) {
    if (!neighbour) { return Status::success(); }
    if (!isFinite(*neighbour)) { return {StatusCode::notFinite, field}; }
    if (loop) { return {StatusCode::outOfRange, field}; }
    if (*neighbour == end) { return {StatusCode::degenerate, field}; }
    if (!isFinite(*neighbour - end)) { return {StatusCode::notFinite, field}; }
    return Status::success();
}

}  // namespace

Polygon polygonOf(const ChainSegment& segment) {
    Polygon polygon;
    polygon.vertices[0] = segment.p;
    polygon.vertices[1] = segment.q;
    polygon.normals[0] = normalOf(segment);
    polygon.normals[1] = -polygon.normals[0];
    polygon.radius = segment.radius;
    polygon.count = 2;
    return polygon;
}

Vec2 normalOf(const ChainSegment& segment) { return edgeNormal(segment.p, segment.q); }

Status validateChain(std::span<const Vec2> points, bool loop, Real radius, const ChainNeighbours& neighbours) {
    if (points.size() < (loop ? 3U : 2U)) { return {StatusCode::tooFewVertices, "points"}; }
    for (const Vec2 point : points) {
        if (!isFinite(point)) { return {StatusCode::notFinite, "points"}; }
    }
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (points[i] == points[i - 1]) { return {StatusCode::degenerate, "points"}; }
        if (!isFinite(points[i] - points[i - 1])) { return {StatusCode::notFinite, "points"}; }
    }
    if (loop && points.front() == points.back()) { return {StatusCode::degenerate, "points"}; }
    if (loop && !isFinite(points.front() - points.back())) { return {StatusCode::notFinite, "points"}; }
    if (!isFinite(radius)) { return {StatusCode::notFinite, "radius"}; }
    if (radius < 0) { return {StatusCode::negative, "radius"}; }
    const Status before = validateNeighbour(neighbours.before, points.front(), loop, "before");
    if (!before.ok()) { return before; }
    return validateNeighbour(neighbours.after, points.back(), loop, "after");
}

ChainSegment chainSegment(std::span<const Vec2> points, bool loop, Real radius, int i,
                          const ChainNeighbours& neighbours) {
    const std::size_t count = points.size();
    const auto first = static_cast<std::size_t>(i);
    const auto cyclic = [&](std::size_t index) { return points[index % count]; };
    ChainSegment segment;
    segment.p = points[first];
    segment.q = cyclic(first + 1);
    segment.radius = radius;
    const std::optional<Vec2> before = loop || first > 0 ? cyclic(first + count - 1) : neighbours.before;
    const std::optional<Vec2> after = loop || first + 2 < count ? cyclic(first + 2) : neighbours.after;
    segment.hasBefore = before.has_value();
    segment.hasAfter = after.has_value();
    segment.before = before.value_or(Vec2{});
    segment.after = after.value_or(Vec2{});
    return segment;
}

}  // namespace swept::inline SWEPT_PRECISION
