#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "../frame.h"
#include "render_paint.h"
#include "render_scene.h"
#include "render_view.h"

namespace swept {

/// Where the bodies have been: lines through their past positions, and pale copies of them at chosen moments.
class MotionTrails {
public:
    /// @param pointLimit  newest points kept per body; 0 keeps all.
    explicit MotionTrails(std::size_t pointLimit) : pointLimit_(pointLimit) {}

    /// Adds the positions of a frame to the lines, and those at which bodies met something on the way there: what is
    /// fast turns round at a wall, not at the last end of a step before it.
    void addPositions(const Frame& frame);
    /// Keeps the poses of a frame as pale copies.
    void addStrobe(const Frame& frame) { strobes_.push_back(frame.bodies); }
    void clear();
    /// Older parts are paler. Bodies that cannot move leave no trail.
    void draw(Paint& paint, const PixelView& view, const SceneDrawing& scene) const;

private:
    void addPoint(std::deque<DVec2>& line, DVec2 point) const;
    void drawStrobes(Paint& paint, const PixelView& view, const SceneDrawing& scene) const;
    void drawLine(Paint& paint, const PixelView& view, const std::deque<DVec2>& line, Color color) const;

    std::size_t pointLimit_;
    std::vector<std::deque<DVec2>> lines_;  // one per body
    std::vector<std::vector<BodyFrame>> strobes_;
};

}  // namespace swept
