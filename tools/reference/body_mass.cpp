#include "body_mass.h"

#include <variant>
#include <vector>

#include <swept/shapes/hull.h>
#include <swept/shapes/mass.h>

namespace swept {
namespace {

/// Our polygon of a geometry, for its mass; a chain has none.
struct PolygonOf {
    Real radius;

    Result<Polygon> operator()(const BoxGeometry& box) const {
        return makeBox(toReal(box.half), toReal(box.center), box.angle, radius);
    }
    Result<Polygon> operator()(const CircleGeometry& circle) const {
        return makeCircle(toReal(circle.center), static_cast<Real>(circle.radius));
    }
    Result<Polygon> operator()(const CapsuleGeometry& capsule) const {
        return makeCapsule(toReal(capsule.points[0]), toReal(capsule.points[1]), static_cast<Real>(capsule.radius));
    }
    Result<Polygon> operator()(const SegmentGeometry& segment) const {
        return makeSegment(toReal(segment.points[0]), toReal(segment.points[1]), radius);
    }
    Result<Polygon> operator()(const PolygonGeometry& polygon) const {
        std::vector<Vec2> points;
        for (const DVec2 point : polygon.points) { points.push_back(toReal(point)); }
        return convexHull(points, radius);
    }
    Result<Polygon> operator()(const ChainGeometry&) const { return Status{StatusCode::wrongBodyType, "chain"}; }
};

}  // namespace

BodyMass massOfBody(const BodyDescription& body) {
    std::vector<MassProperties> parts;
    for (const ShapeDescription& shape : body.shapes) {
        const Result<Polygon> polygon = std::visit(PolygonOf{static_cast<Real>(shape.radius)}, shape.geometry);
        if (polygon.ok()) { parts.push_back(massOf(polygon.value(), static_cast<Real>(shape.density))); }
    }
    const MassProperties whole = combine(parts);
    BodyMass mass{whole.mass, whole.center, whole.inertia};
    if (body.mass) {
        // The same distribution of mass, heavier or lighter.
        if (whole.mass > 0) { mass.inertia *= *body.mass / whole.mass; }
        mass.mass = *body.mass;
    }
    if (body.inertia) { mass.inertia = *body.inertia; }
    return mass;
}

}  // namespace swept
