#include "deviation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace swept {
namespace {

constexpr double kVisibleShare = 0.1;

/// A box about points of the body frame, grown as they come.
struct BodyBounds {
    DVec2 lower{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    DVec2 upper{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    void add(DVec2 point, double radius) {
        lower = {std::min(lower.x, point.x - radius), std::min(lower.y, point.y - radius)};
        upper = {std::max(upper.x, point.x + radius), std::max(upper.y, point.y + radius)};
    }
    double size() const { return std::max({0.0, upper.x - lower.x, upper.y - lower.y}); }
};

struct GeometryAdder {
    BodyBounds& bounds;
    double radius;

    void operator()(const BoxGeometry& box) const {
        const DVec2 axis{std::cos(box.angle), std::sin(box.angle)};
        for (const double x : {-box.half.x, box.half.x}) {
            for (const double y : {-box.half.y, box.half.y}) {
                bounds.add(box.center + DVec2{axis.x * x - axis.y * y, axis.y * x + axis.x * y}, radius);
            }
        }
    }
    void operator()(const CircleGeometry& circle) const { bounds.add(circle.center, circle.radius); }
    void operator()(const CapsuleGeometry& capsule) const {
        for (const DVec2 point : capsule.points) { bounds.add(point, capsule.radius); }
    }
    void operator()(const SegmentGeometry& segment) const {
        for (const DVec2 point : segment.points) { bounds.add(point, radius); }
    }
    void operator()(const PolygonGeometry& polygon) const {
        for (const DVec2 point : polygon.points) { bounds.add(point, radius); }
    }
    void operator()(const ChainGeometry& chain) const {
        for (const DVec2 point : chain.points) { bounds.add(point, radius); }
    }
};

}  // namespace

Deviation deviationOf(const SceneDescription& scene, const Frame& ours, const Frame& theirs) {
    Deviation deviation;
    deviation.step = ours.step;
    deviation.time = ours.time;
    double sum = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].type != SceneBodyType::dynamic) { continue; }
        const BodyFrame& a = ours.bodies[i];
        const BodyFrame& b = theirs.bodies[i];
        const BodyDeviation body{static_cast<int>(i), length(a.position - b.position), std::abs(a.angle - b.angle),
                                 length(a.velocity - b.velocity)};
        if (deviation.worstBody < 0 || body.position > deviation.worstPosition) {
            deviation.worstPosition = body.position;
            deviation.worstBody = body.body;
        }
        deviation.worstAngle = std::max(deviation.worstAngle, body.angle);
        sum += body.position;
        deviation.bodies.push_back(body);
    }
    if (!deviation.bodies.empty()) { deviation.meanPosition = sum / static_cast<double>(deviation.bodies.size()); }
    return deviation;
}

double visibleDeviation(const SceneDescription& scene) {
    double smallest = 0;
    for (const BodyDescription& body : scene.bodies) {
        if (body.type != SceneBodyType::dynamic || body.shapes.empty()) { continue; }
        BodyBounds bounds;
        for (const ShapeDescription& shape : body.shapes) {
            std::visit(GeometryAdder{bounds, shape.radius}, shape.geometry);
        }
        if (smallest <= 0 || bounds.size() < smallest) { smallest = bounds.size(); }
    }
    return kVisibleShare * smallest;
}

}  // namespace swept
