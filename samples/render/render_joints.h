#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "../scene_description.h"
#include "render_paint.h"
#include "render_view.h"

namespace swept {

/// What is drawn for a joint.
enum class JointMark : std::uint8_t { pin, rod, spring, slide, wheel, seam, arrow, pull, mesh, pulley, none };

/// A joint of a scene, made ready for drawing at any pose of its bodies.
struct JointDrawing {
    JointMark mark = JointMark::none;
    int bodyA = 0;
    int bodyB = 0;
    DVec2 localA;  ///< anchors, in the frames of the bodies
    DVec2 localB;
    DVec2 localAxis;  ///< in the frame of A
    DVec2 worldA;     ///< wheels of a pulley; target of a mouse joint
    DVec2 worldB;
    bool sprung = false;
    int joint = 0;                      ///< index in the scene
    std::array<int, 2> geared{-1, -1};  ///< of the joints of a gear, which goes with either of them; −1: it is no gear
};

/// Empty when its bodies (or the joints of a gear) do not exist, or there is nothing to see of it.
std::optional<JointDrawing> jointDrawing(const SceneDescription& scene, std::size_t index);

/// A joint where its bodies are.
struct PlacedJoint {
    const JointDrawing& joint;
    const PixelPose& poseA;
    const PixelPose& poseB;
    bool movesA = false;  ///< false: the body is static, and its origin may be anywhere
    bool movesB = false;
};
void drawJoint(Paint& paint, const PixelView& view, const PlacedJoint& placed);

}  // namespace swept
