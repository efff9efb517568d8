#include "render_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <variant>
#include <vector>

#include "../scene_reader.h"
#include "../scene_surfaces.h"
#include "render_belt.h"
#include "render_chain.h"
#include "stroke_font.h"

namespace swept {

namespace {

/// Thinner shapes are drawn this thick, in pixels: a bullet or a wall must never be invisible.
constexpr double kThinnest = 1.6;
/// Thinner shapes show their edge only.
constexpr double kThinnestWithFill = 2.6;
constexpr double kSegmentThickness = 2.2;
/// A sweep that turns is drawn in pieces of so many radians, which differ from the true one by less than a line's
/// width.
constexpr double kSweptTurn = 0.08;
constexpr int kMostSweptPieces = 400;

ShapeCore coreInPixels(const PixelPose& pose, const ShapeCore& core, double thinnest = kThinnest) {
    ShapeCore pixels{{}, core.radius * pose.scale()};
    for (const DVec2 p : core.points) { pixels.points.push_back(pose.toPixels(p)); }
    pixels.radius += std::max(0.0, (thinnest * pose.pen() - narrowestWidth(pixels)) / 2);
    return pixels;
}

}  // namespace

SceneDrawing::SceneDrawing(const SceneDescription& scene) {
    std::size_t dynamicBodies = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const BodyDescription& body = scene.bodies[i];
        BodyDrawing drawing{bodyName(scene, i), body.type, body.bullet, dynamicBodies, {}};
        dynamicBodies += body.type == SceneBodyType::dynamic ? 1 : 0;
        for (const ShapeDescription& shape : body.shapes) { drawing.shapes.push_back(shapeDrawing(shape)); }
        bodies_.push_back(std::move(drawing));
    }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (const auto drawing = jointDrawing(scene, i)) { joints_.push_back(*drawing); }
    }
}

SceneDrawing::ShapeDrawing SceneDrawing::shapeDrawing(const ShapeDescription& shape) {
    ShapeDrawing drawing{shapeCore(shape.geometry, shape.radius), Kind::convex, false, shape.sensor, {}};
    for (const FullSurface& surface : surfacesOf(shape)) { drawing.speeds.push_back(surface.surfaceSpeed); }
    if (const auto* chain = std::get_if<ChainGeometry>(&shape.geometry)) {
        drawing.kind = Kind::chain;
        drawing.loop = chain->loop;
    } else if (std::holds_alternative<CircleGeometry>(shape.geometry)) {
        drawing.kind = Kind::circle;
    } else if (std::holds_alternative<SegmentGeometry>(shape.geometry)) {
        drawing.kind = Kind::segment;
    }
    return drawing;
}

style::BodyStyle SceneDrawing::styleOf(std::size_t body, bool awake) const {
    const BodyDrawing& drawing = bodies_[body];
    return style::bodyStyle(drawing.type, drawing.bullet, awake, drawing.paletteIndex);
}

void SceneDrawing::removeJoint(int joint) {
    std::erase_if(joints_, [joint](const JointDrawing& j) {
        return j.joint == joint || j.geared[0] == joint || j.geared[1] == joint;
    });
}

void SceneDrawing::drawBodies(Paint& paint, const PixelView& view, const Frame& frame) const {
    const std::size_t count = std::min(bodies_.size(), frame.bodies.size());
    const auto eachShape = [&](auto&& wanted, auto&& drawShape) {
        for (std::size_t i = 0; i < count; ++i) {
            const PixelPose pose(view, frame.bodies[i].position, frame.bodies[i].angle);
            if (!pose.finite()) { continue; }
            for (const ShapeDrawing& shape : bodies_[i].shapes) {
                if (wanted(bodies_[i], shape)) { drawShape(i, pose, shape); }
            }
        }
    };
    eachShape([](const BodyDrawing&, const ShapeDrawing& shape) { return shape.sensor; },
              [&](std::size_t, const PixelPose& pose, const ShapeDrawing& shape) { drawSensor(paint, pose, shape); });
    for (const SceneBodyType type : {SceneBodyType::fixed, SceneBodyType::kinematic, SceneBodyType::dynamic}) {
        eachShape([type](const BodyDrawing& b, const ShapeDrawing& shape) { return b.type == type && !shape.sensor; },
                  [&](std::size_t i, const PixelPose& pose, const ShapeDrawing& shape) {
                      const style::BodyStyle look = styleOf(i, frame.bodies[i].awake);
                      if (shape.kind == Kind::chain) {
                          drawChain(paint, pose, shape, look);
                      } else {
                          drawConvex(paint, pose, shape, look);
                      }
                      drawBelt(paint, pose, shape, look, frame.time);
                  });
    }
}

void SceneDrawing::drawConvex(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape,
                              const style::BodyStyle& look) const {
    const bool segment = shape.kind == Kind::segment;
    const ShapeCore core = coreInPixels(pose, shape.core, segment ? kSegmentThickness : kThinnest);
    const double edge = style::kEdgeWidth * pose.pen();
    paint.fillConvex(roundedOutline(core, paint.box()), look.edge);
    // The edge lies inside the shape, so that touching shapes touch in the picture; thin shapes keep some of their
    // fill.
    const double width = narrowestWidth(core);
    if (width > kThinnestWithFill * pose.pen()) {
        paint.fillConvex(roundedOutline(insetCore(core, std::min(edge, 0.25 * width), paint.box()), paint.box()),
                         look.fill);
    }
    if (shape.kind == Kind::circle && core.radius > 3 * edge) {
        const DVec2 tip = pose.toPixels(shape.core.points[0] + DVec2{shape.core.radius, 0});
        paint.line(core.points[0], tip, edge, look.edge);
    }
}

void SceneDrawing::drawChain(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape,
                             const style::BodyStyle& look) const {
    ShapeCore core{{}, shape.core.radius * pose.scale()};
    for (const DVec2 p : shape.core.points) { core.points.push_back(pose.toPixels(p)); }
    shadeSolidSide(paint, core.points, shape.loop, look.edge, pose.pen());
    const double thickness = std::max(kSegmentThickness * pose.pen(), 2 * core.radius);
    const double edge = style::kEdgeWidth * pose.pen();
    paint.polyline(core.points, shape.loop, thickness, look.edge);
    if (thickness > 3 * edge) { paint.polyline(core.points, shape.loop, thickness - 2 * edge, look.fill); }
}

/// @param time  since the start, s
void SceneDrawing::drawBelt(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape,
                            const style::BodyStyle& look, double time) const {
    if (std::all_of(shape.speeds.begin(), shape.speeds.end(), [](double speed) { return speed == 0; })) { return; }
    const auto mark = [&](std::span<const DVec2> points, bool loop, double speed) {
        if (speed == 0) { return; }
        // Clockwise, and so against the points.
        markBelt(paint, points, loop, -speed * pose.scale() * time, speed < 0, look.edge, pose.pen());
    };
    const bool isChain = shape.kind == Kind::chain;
    const ShapeCore core = coreInPixels(pose, shape.core);
    if (shape.speeds.size() == 1) {
        return mark(isChain ? core.points : roundedOutline(core, paint.box()), !isChain || shape.loop, shape.speeds[0]);
    }
    for (std::size_t i = 0; i < shape.speeds.size(); ++i) {
        mark(std::array{core.points[i], core.points[(i + 1) % core.points.size()]}, false, shape.speeds[i]);
    }
}

void SceneDrawing::drawSensor(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape) const {
    if (shape.kind != Kind::chain) {
        const ShapeCore core = coreInPixels(pose, shape.core);
        paint.fillConvex(roundedOutline(core, paint.box()), withAlpha(style::kSensor, 32));
        paint.dashed(roundedOutline(core, paint.box()), true, 1.3 * pose.pen(), 5 * pose.pen(), 3.5 * pose.pen(),
                     style::kSensor);
        return;
    }
    std::vector<DVec2> points;
    for (const DVec2 p : shape.core.points) { points.push_back(pose.toPixels(p)); }
    paint.dashed(points, shape.loop, 1.3 * pose.pen(), 5 * pose.pen(), 3.5 * pose.pen(), style::kSensor);
}

void SceneDrawing::drawOutline(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape, Color color) const {
    const ShapeCore core = coreInPixels(pose, shape.core);
    const bool chain = shape.kind == Kind::chain;
    // A closed stroke of a full circle begins and ends at the same point; a zero-length edge does no harm.
    paint.polyline(chain ? core.points : roundedOutline(core, paint.box()), !chain || shape.loop, 1.5 * pose.pen(),
                   color);
    if (shape.kind == Kind::circle) {
        paint.line(core.points[0], pose.toPixels(shape.core.points[0] + DVec2{shape.core.radius, 0}), 1.2 * pose.pen(),
                   color);
    }
}

void SceneDrawing::drawOutlines(Paint& paint, const PixelView& view, const Frame& frame, Color color) const {
    for (std::size_t i = 0; i < std::min(bodies_.size(), frame.bodies.size()); ++i) {
        const PixelPose pose(view, frame.bodies[i].position, frame.bodies[i].angle);
        if (!moves(i) || !pose.finite()) { continue; }
        for (const ShapeDrawing& shape : bodies_[i].shapes) { drawOutline(paint, pose, shape, color); }
    }
}

void SceneDrawing::drawPale(Paint& paint, const PixelView& view, std::size_t body, const BodyFrame& state,
                            double strength) const {
    const PixelPose pose(view, state.position, state.angle);
    if (!pose.finite()) { return; }
    const style::BodyStyle own = styleOf(body, true);
    const style::BodyStyle pale{mix(style::kBackground, own.fill, strength),
                                mix(style::kBackground, own.edge, strength)};
    for (const ShapeDrawing& shape : bodies_[body].shapes) {
        if (!shape.sensor && shape.kind != Kind::chain) { drawConvex(paint, pose, shape, pale); }
    }
}

void SceneDrawing::drawGhost(Paint& paint, const PixelView& view, std::size_t body, const BodyFrame& state,
                             Color color) const {
    const PixelPose pose(view, state.position, state.angle);
    if (!pose.finite()) { return; }
    for (const ShapeDrawing& shape : bodies_[body].shapes) {
        const std::vector<DVec2> outline = roundedOutline(coreInPixels(pose, shape.core), paint.box());
        paint.fillConvex(outline, withAlpha(color, 36));
        paint.dashed(outline, true, 1.4 * pose.pen(), 4 * pose.pen(), 3 * pose.pen(), color);
    }
}

void SceneDrawing::drawSwept(Paint& paint, const PixelView& view, std::size_t body, const BodyFrame& from,
                             const BodyFrame& to) const {
    // Opaque, so that the pieces of a turning sweep do not add up where they overlap.
    const Color tone = mix(style::kBackground, styleOf(body, true).fill, style::kSweptTone);
    const double turn = std::fabs(to.angle - from.angle);
    // Clamped first: a body may turn by more than fits into an int.
    const double wanted = std::clamp(std::ceil(turn / kSweptTurn), 1.0, static_cast<double>(kMostSweptPieces));
    const auto pieces = static_cast<int>(wanted);
    const auto poseAt = [&](int i) {
        const double t = static_cast<double>(i) / pieces;
        return PixelPose(view, from.position + t * (to.position - from.position),
                         from.angle + t * (to.angle - from.angle));
    };
    for (const ShapeDrawing& shape : bodies_[body].shapes) {
        // The hull of a chain is not what the chain sweeps (a drum is hollow), and a sensor stops nothing.
        if (shape.sensor || shape.kind == Kind::chain) { continue; }
        for (int i = 0; i < pieces; ++i) {
            std::vector<DVec2> both = roundedOutline(coreInPixels(poseAt(i), shape.core), paint.box());
            const std::vector<DVec2> next = roundedOutline(coreInPixels(poseAt(i + 1), shape.core), paint.box());
            both.insert(both.end(), next.begin(), next.end());
            paint.fillConvex(convexHull(std::move(both)), tone);
        }
    }
}

void SceneDrawing::drawJoints(Paint& paint, const PixelView& view, const Frame& frame) const {
    for (const JointDrawing& joint : joints_) {
        const auto a = static_cast<std::size_t>(joint.bodyA);
        const auto b = static_cast<std::size_t>(joint.bodyB);
        if (std::max(a, b) >= frame.bodies.size()) { continue; }
        const PixelPose poseA(view, frame.bodies[a].position, frame.bodies[a].angle);
        const PixelPose poseB(view, frame.bodies[b].position, frame.bodies[b].angle);
        if (poseA.finite() && poseB.finite()) { drawJoint(paint, view, {joint, poseA, poseB, moves(a), moves(b)}); }
    }
}

void SceneDrawing::drawNames(Paint& paint, const PixelView& view, const Frame& frame, double textHeight) const {
    std::vector<PixelBox> written;
    for (std::size_t i = 0; i < std::min(bodies_.size(), frame.bodies.size()); ++i) {
        const DVec2 p = view.toPixels(frame.bodies[i].position);
        if (!isFinite(p) || !paint.box().contains(p)) { continue; }
        const DVec2 half{textWidth(bodies_[i].name, textHeight) / 2 + 3, 0.5 * textHeight + 3};
        const PixelBox box{p - half, p + half};
        const auto overlaps = [&box](const PixelBox& other) {
            return box.low.x < other.high.x && box.high.x > other.low.x && box.low.y < other.high.y &&
                   box.high.y > other.low.y;
        };
        if (std::any_of(written.begin(), written.end(), overlaps)) { continue; }
        written.push_back(box);
        paint.fillBox(box, 3, withAlpha(rgb(0xFFFFFF), 165));
        drawText(paint, bodies_[i].name, p - DVec2{0, 0.5 * textHeight}, textHeight, style::kText, TextAlign::center);
    }
}

}  // namespace swept
