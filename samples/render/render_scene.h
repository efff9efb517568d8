#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "../frame.h"
#include "../scene_description.h"
#include "render_joints.h"
#include "render_outline.h"
#include "render_paint.h"
#include "render_style.h"
#include "render_view.h"

namespace swept {

/// The bodies and joints of a scene, made ready for drawing once and then drawn at the poses of any frame. A body whose
/// pose is not finite is left out.
class SceneDrawing {
public:
    explicit SceneDrawing(const SceneDescription& scene);

    /// Fills, in this order: sensors, static, kinematic, dynamic bodies.
    void drawBodies(Paint& paint, const PixelView& view, const Frame& frame) const;
    /// All bodies that can move, as outlines of one colour.
    void drawOutlines(Paint& paint, const PixelView& view, const Frame& frame, Color color) const;
    /// One body as it was at another time: a pale fill under its own outline. `strength` 1 is the body's own colour.
    void drawPale(Paint& paint, const PixelView& view, std::size_t body, const BodyFrame& state, double strength) const;
    /// One body as a translucent fill with a dashed outline.
    void drawGhost(Paint& paint, const PixelView& view, std::size_t body, const BodyFrame& state, Color color) const;
    /// What one body sweeps between two states, turning steadily, in a pale tone of its own colour.
    void drawSwept(Paint& paint, const PixelView& view, std::size_t body, const BodyFrame& from,
                   const BodyFrame& to) const;
    void drawJoints(Paint& paint, const PixelView& view, const Frame& frame) const;
    /// Of each body at its origin, in the order of the scene, unless an earlier name is in the way.
    void drawNames(Paint& paint, const PixelView& view, const Frame& frame, double textHeight) const;

    /// From now on, this joint of the scene is not drawn, nor a gear on it.
    void removeJoint(int joint);
    std::size_t bodyCount() const { return bodies_.size(); }
    bool moves(std::size_t body) const { return bodies_[body].type != SceneBodyType::fixed; }
    style::BodyStyle styleOf(std::size_t body, bool awake) const;

private:
    enum class Kind : std::uint8_t { convex, circle, segment, chain };
    struct ShapeDrawing {
        ShapeCore core;  // frame of the body, metres
        Kind kind = Kind::convex;
        bool loop = false;
        bool sensor = false;
        std::vector<double> speeds;  // of its surface, m/s, clockwise: one, or that of each segment
    };
    struct BodyDrawing {
        std::string name;
        SceneBodyType type = SceneBodyType::fixed;
        bool bullet = false;
        std::size_t paletteIndex = 0;
        std::vector<ShapeDrawing> shapes;
    };

    static ShapeDrawing shapeDrawing(const ShapeDescription& shape);
    void drawConvex(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape, const style::BodyStyle& look) const;
    void drawChain(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape, const style::BodyStyle& look) const;
    void drawBelt(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape, const style::BodyStyle& look,
                  double time) const;
    void drawSensor(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape) const;
    void drawOutline(Paint& paint, const PixelPose& pose, const ShapeDrawing& shape, Color color) const;

    std::vector<BodyDrawing> bodies_;
    std::vector<JointDrawing> joints_;
};

}  // namespace swept
