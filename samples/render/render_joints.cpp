#include "render_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "../scene_reader.h"
#include "render_style.h"

namespace swept {
namespace {

/// A zigzag between two points, with straight ends.
std::vector<DVec2> springPath(DVec2 p, DVec2 q, double pen) {
    constexpr int kTurns = 12;
    const DVec2 along = q - p;
    const double size = std::hypot(along.x, along.y);
    if (!(size > 0) || !std::isfinite(size)) { return {p, q}; }
    const DVec2 side = std::min(5 * pen, size / 8) / size * DVec2{-along.y, along.x};
    std::vector<DVec2> path{p, p + 0.12 * along};
    for (int i = 0; i < kTurns; ++i) {
        const double t = 0.12 + 0.76 * (i + 0.5) / kTurns;
        path.push_back(p + t * along + (i % 2 == 0 ? 1.0 : -1.0) * side);
    }
    path.push_back(p + 0.88 * along);
    path.push_back(q);
    return path;
}

void pin(Paint& paint, DVec2 p, double radius) {
    paint.disc(p, radius, style::kJoint);
    paint.disc(p, radius * 0.48, rgb(0xFFFFFF));
}

DVec2 toLocal(const BodyDescription& body, DVec2 world) {
    const DVec2 d = world - body.position;
    const double c = std::cos(body.angle);
    const double s = std::sin(body.angle);
    return {c * d.x + s * d.y, c * d.y - s * d.x};
}

DVec2 turned(double angle, DVec2 v) {
    return {std::cos(angle) * v.x - std::sin(angle) * v.y, std::sin(angle) * v.x + std::cos(angle) * v.y};
}

/// Index of the body of a name; the number of bodies when there is none.
std::size_t bodyIndex(const SceneDescription& scene, const std::string& name) {
    std::size_t i = 0;
    while (i < scene.bodies.size() && bodyName(scene, i) != name) { ++i; }
    return i;
}

/// A joint that can be geared.
struct GearedJoint {
    int index = 0;
    DVec2 anchor;  ///< world
};

std::optional<GearedJoint> gearedJoint(const SceneDescription& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        if (jointName(scene, i) != name) { continue; }
        if (const auto* revolute = std::get_if<RevoluteDescription>(&scene.joints[i].joint)) {
            return GearedJoint{static_cast<int>(i), revolute->anchor};
        }
        if (const auto* prismatic = std::get_if<PrismaticDescription>(&scene.joints[i].joint)) {
            return GearedJoint{static_cast<int>(i), prismatic->anchor};
        }
    }
    return std::nullopt;
}

/// Fills a drawing in by the type of the joint.
struct DrawingMaker {
    const SceneDescription& scene;
    const BodyDescription& a;
    const BodyDescription& b;
    JointDrawing& drawing;

    void anchors(JointMark mark, DVec2 onA, DVec2 onB) const {
        drawing.mark = mark;
        drawing.localA = toLocal(a, onA);
        drawing.localB = toLocal(b, onB);
    }
    template <class Members>
    static DVec2 anchorB(const Members& joint) {
        return joint.anchorB.value_or(joint.anchor);
    }
    void axis(DVec2 world) const {
        const double size = std::hypot(world.x, world.y);
        drawing.localAxis = size > 0 ? turned(-a.angle, (1 / size) * world) : DVec2{};
    }
    void operator()(const RevoluteDescription& joint) const { anchors(JointMark::pin, joint.anchor, anchorB(joint)); }
    void operator()(const DistanceDescription& joint) const {
        anchors(joint.hertz ? JointMark::spring : JointMark::rod, joint.anchorA, joint.anchorB);
    }
    void operator()(const PrismaticDescription& joint) const {
        anchors(JointMark::slide, joint.anchor, anchorB(joint));
        axis(joint.axis);
        drawing.sprung = joint.hertz.has_value();
    }
    void operator()(const WheelDescription& joint) const {
        anchors(JointMark::wheel, joint.anchor, anchorB(joint));
        axis(joint.axis);
        drawing.sprung = joint.hertz.has_value();
    }
    void operator()(const WeldDescription& joint) const {
        anchors(JointMark::seam, joint.anchor, anchorB(joint));
        drawing.sprung = joint.linearHertz || joint.angularHertz;
    }
    void operator()(const MotorDescription& joint) const {
        const DVec2 wanted = joint.linearOffset ? a.position + turned(a.angle, *joint.linearOffset) : b.position;
        anchors(JointMark::arrow, wanted, b.position);
    }
    void operator()(const MouseDescription& joint) const {
        anchors(JointMark::pull, joint.target, joint.anchor.value_or(joint.target));
        drawing.worldA = joint.target;
    }
    void operator()(const GearDescription& joint) const {
        const std::optional<GearedJoint> first = gearedJoint(scene, joint.jointA);
        const std::optional<GearedJoint> second = gearedJoint(scene, joint.jointB);
        if (!first || !second) { return; }
        anchors(JointMark::mesh, first->anchor, second->anchor);
        drawing.geared = {first->index, second->index};
    }
    void operator()(const PulleyDescription& joint) const {
        anchors(JointMark::pulley, joint.anchorA, joint.anchorB);
        drawing.worldA = joint.groundA;
        drawing.worldB = joint.groundB;
    }
    void operator()(const FilterJointDescription&) const {}
};

/// The arms from body to pin; a static body has none, its origin may be anywhere.
void drawArms(Paint& paint, const PlacedJoint& placed, DVec2 anchorA, DVec2 anchorB, double pen) {
    if (placed.movesA) { paint.line(placed.poseA.origin(), anchorA, 1.1 * pen, style::kJoint); }
    if (placed.movesB) { paint.line(placed.poseB.origin(), anchorB, 1.1 * pen, style::kJoint); }
}

/// Direction of the axis in pixels, of unit length.
DVec2 axisInPixels(const PlacedJoint& placed) {
    const DVec2 along = placed.poseA.toPixels(placed.joint.localAxis) - placed.poseA.origin();
    const double size = std::hypot(along.x, along.y);
    return size > 0 ? (1 / size) * along : DVec2{1, 0};
}

/// The rail from A's anchor to B's and a bit beyond, and a block on it.
void drawSlide(Paint& paint, const PlacedJoint& placed, DVec2 anchorA, DVec2 anchorB, double pen) {
    const DVec2 axis = axisInPixels(placed);
    const DVec2 side = 4 * pen * DVec2{-axis.y, axis.x};
    const DVec2 block = 6 * pen * axis;
    paint.line(anchorA - 14 * pen * axis, anchorA + 14 * pen * axis, 1.1 * pen, style::kJoint);
    if (placed.joint.sprung) {
        paint.polyline(springPath(anchorA, anchorB, pen), false, 1.3 * pen, style::kJoint);
    } else {
        paint.line(anchorA, anchorB, 1.1 * pen, style::kJoint);
    }
    const std::array<DVec2, 4> corners{anchorB - block - side, anchorB + block - side, anchorB + block + side,
                                       anchorB - block + side};
    paint.fillConvex(corners, withAlpha(rgb(0xFFFFFF), 200));
    paint.polyline(corners, true, 1.3 * pen, style::kJoint);
    paint.disc(anchorA, 2 * pen, style::kJoint);
}

/// The suspension hangs from a point of the axis above the wheel: where the body begins, as far as that is known.
void drawWheel(Paint& paint, const PlacedJoint& placed, DVec2 anchorA, DVec2 anchorB, double pen) {
    const DVec2 top = anchorA + 18 * pen * axisInPixels(placed);
    if (placed.joint.sprung) {
        paint.polyline(springPath(top, anchorB, pen), false, 1.3 * pen, style::kJoint);
    } else {
        paint.line(top, anchorB, 1.1 * pen, style::kJoint);
    }
    paint.disc(top, 2 * pen, style::kJoint);
    pin(paint, anchorB, 3 * pen);
}

/// A cross in a square; open where it is sprung.
void drawSeam(Paint& paint, const PlacedJoint& placed, DVec2 anchorA, DVec2 anchorB, double pen) {
    const double size = 3.4 * pen;
    const DVec2 p{size, size};
    const DVec2 q{size, -size};
    paint.line(anchorA, anchorB, 2 * pen, style::kWarning);
    if (!placed.joint.sprung) { paint.fillBox({anchorA - 1.2 * p, anchorA + 1.2 * p}, pen, style::kJoint); }
    const Color cross = placed.joint.sprung ? style::kJoint : rgb(0xFFFFFF);
    paint.line(anchorA - p, anchorA + p, 1.3 * pen, cross);
    paint.line(anchorA - q, anchorA + q, 1.3 * pen, cross);
}

void drawPulley(Paint& paint, const PixelView& view, const JointDrawing& joint, DVec2 anchorA, DVec2 anchorB) {
    const DVec2 wheelA = view.toPixels(joint.worldA);
    const DVec2 wheelB = view.toPixels(joint.worldB);
    const std::array<DVec2, 4> rope{anchorA, wheelA, wheelB, anchorB};
    paint.polyline(rope, false, 1.3 * view.pen, style::kJoint);
    for (const DVec2 wheel : {wheelA, wheelB}) { pin(paint, wheel, 6 * view.pen); }
    for (const DVec2 end : {anchorA, anchorB}) { pin(paint, end, 2.6 * view.pen); }
}

}  // namespace

std::optional<JointDrawing> jointDrawing(const SceneDescription& scene, std::size_t index) {
    const JointDescription& joint = scene.joints[index];
    const std::size_t a = bodyIndex(scene, joint.bodyA);
    const std::size_t b = bodyIndex(scene, joint.bodyB);
    if (std::max(a, b) >= scene.bodies.size()) { return std::nullopt; }
    JointDrawing drawing;
    drawing.bodyA = static_cast<int>(a);
    drawing.bodyB = static_cast<int>(b);
    drawing.joint = static_cast<int>(index);
    std::visit(DrawingMaker{scene, scene.bodies[a], scene.bodies[b], drawing}, joint.joint);
    return drawing.mark == JointMark::none ? std::nullopt : std::optional(drawing);
}

void drawJoint(Paint& paint, const PixelView& view, const PlacedJoint& placed) {
    const JointDrawing& joint = placed.joint;
    const DVec2 anchorA = placed.poseA.toPixels(joint.localA);
    const DVec2 anchorB = placed.poseB.toPixels(joint.localB);
    const double pen = view.pen;
    const std::array<DVec2, 2> ends{anchorA, anchorB};
    switch (joint.mark) {
        case JointMark::pin:
            drawArms(paint, placed, anchorA, anchorB, pen);
            paint.line(anchorA, anchorB, 2 * pen, style::kWarning);  // of no length unless the joint is torn apart
            pin(paint, anchorA, 3 * pen);
            return;
        case JointMark::rod:
        case JointMark::spring:
            if (joint.mark == JointMark::spring) {
                paint.polyline(springPath(anchorA, anchorB, pen), false, 1.3 * pen, style::kJoint);
            } else {
                paint.polyline(ends, false, 1.3 * pen, style::kJoint);
            }
            for (const DVec2 end : ends) { pin(paint, end, 2.6 * pen); }
            return;
        case JointMark::slide:
            return drawSlide(paint, placed, anchorA, anchorB, pen);
        case JointMark::wheel:
            return drawWheel(paint, placed, anchorA, anchorB, pen);
        case JointMark::seam:
            return drawSeam(paint, placed, anchorA, anchorB, pen);
        case JointMark::arrow:
            paint.dashed(ends, false, 1.1 * pen, 5 * pen, 3.5 * pen, style::kJoint);
            paint.disc(anchorA, 2 * pen, style::kJoint);
            pin(paint, anchorB, 2.6 * pen);
            return;
        case JointMark::pull: {
            const std::array<DVec2, 2> line{view.toPixels(joint.worldA), anchorB};
            paint.dashed(line, false, 1.1 * pen, 5 * pen, 3.5 * pen, style::kJoint);
            pin(paint, line[0], 4 * pen);
            paint.disc(anchorB, 2 * pen, style::kJoint);
            return;
        }
        case JointMark::mesh:
            return paint.dashed(ends, false, 1.1 * pen, 2 * pen, 3 * pen, style::kJoint);
        case JointMark::pulley:
            return drawPulley(paint, view, joint, anchorA, anchorB);
        case JointMark::none:
            return;
    }
}

}  // namespace swept
