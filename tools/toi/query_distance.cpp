#include "query_distance.h"

#include <type_traits>

#include "../../shapes/distance.h"

namespace swept {
namespace {

constexpr Precision kPrecision = std::is_same_v<Real, double> ? Precision::f64 : Precision::f32;

/// Vertices relative to the centre of mass, as this precision sees them.
Polygon roundedPolygon(const ToiPolygon& source, DVec2 center) {
    Polygon polygon;
    polygon.count = source.count;
    polygon.radius = static_cast<Real>(source.radius);
    for (std::size_t i = 0; i < static_cast<std::size_t>(source.count); ++i) {
        polygon.vertices[i] = toReal(source.vertices[i] - center);
    }
    for (int i = 0; polygon.count > 1 && i < polygon.count; ++i) {
        const Vec2 from = polygon.vertices[static_cast<std::size_t>(i)];
        const Vec2 to = polygon.vertices[static_cast<std::size_t>(polygon.next(i))];
        polygon.normals[static_cast<std::size_t>(i)] = normalized(rightPerp(to - from)).unit;
    }
    return polygon;
}

/// Rounding may flatten a polygon or run over the largest number.
Status validateRounded(const Polygon& polygon) {
    ToiPolygon same;
    same.count = polygon.count;
    same.radius = static_cast<double>(polygon.radius);
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        same.vertices[i] = toDouble(polygon.vertices[i]);
    }
    return validateToiPolygon(same);
}

}  // namespace

template <>
Result<QueryDistance> queryDistance<kPrecision>(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b,
                                                const Sweep& sweepB) {
    const Polygon polygonA = roundedPolygon(a, sweepA.localCenter);
    const Polygon polygonB = roundedPolygon(b, sweepB.localCenter);
    if (const Status status = validateRounded(polygonA); !status.ok()) { return Status{status.code, "a"}; }
    if (const Status status = validateRounded(polygonB); !status.ok()) { return Status{status.code, "b"}; }
    const WorldTransform poseA{sweepA.c0, rotationFromAngle(sweepA.a0)};
    const WorldTransform poseB{sweepB.c0, rotationFromAngle(sweepB.a0)};
    const Transform bInA = relativeTransform(poseA, poseB);
    if (!isFinite(bInA.translation)) { return Status{StatusCode::outOfRange, "sweep"}; }
    const Distance found = distance(polygonA, polygonB, bInA);
    QueryDistance answer;
    answer.distance = static_cast<double>(found.distance);
    answer.normal = toDouble(rotate(poseA.rotation, found.normal));
    answer.pointA = apply(poseA, found.pointA);
    answer.pointB = apply(poseA, found.pointB);
    answer.iterations = found.iterations;
    return answer;
}

}  // namespace swept
