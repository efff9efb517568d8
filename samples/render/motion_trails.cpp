#include "motion_trails.h"

#include <algorithm>
#include <cmath>

namespace swept {

namespace {

constexpr double kOldestStrength = 0.22;  // of a colour over the background
constexpr double kNewestStrength = 0.9;
constexpr double kNewestStrobe = 0.55;

}  // namespace

void MotionTrails::addPositions(const Frame& frame) {
    lines_.resize(std::max(lines_.size(), frame.bodies.size()));
    for (const ImpactFrame& impact : frame.impacts) {
        const auto body = static_cast<std::size_t>(impact.body);
        if (impact.body >= 0 && body < frame.bodies.size()) { addPoint(lines_[body], impact.position); }
    }
    for (std::size_t i = 0; i < frame.bodies.size(); ++i) { addPoint(lines_[i], frame.bodies[i].position); }
}

void MotionTrails::addPoint(std::deque<DVec2>& line, DVec2 point) const {
    line.push_back(point);
    if (pointLimit_ > 0 && line.size() > pointLimit_) { line.pop_front(); }
}

void MotionTrails::clear() {
    lines_.clear();
    strobes_.clear();
}

void MotionTrails::draw(Paint& paint, const PixelView& view, const SceneDrawing& scene) const {
    drawStrobes(paint, view, scene);
    for (std::size_t i = 0; i < std::min(lines_.size(), scene.bodyCount()); ++i) {
        if (scene.moves(i)) {
            const style::BodyStyle look = scene.styleOf(i, true);
            drawLine(paint, view, lines_[i], mix(look.fill, look.edge, 0.4));
        }
    }
}

void MotionTrails::drawStrobes(Paint& paint, const PixelView& view, const SceneDrawing& scene) const {
    for (std::size_t k = 0; k < strobes_.size(); ++k) {
        const double age = static_cast<double>(k + 1) / static_cast<double>(strobes_.size());
        for (std::size_t i = 0; i < std::min(strobes_[k].size(), scene.bodyCount()); ++i) {
            if (!scene.moves(i)) { continue; }
            scene.drawPale(paint, view, i, strobes_[k][i], kOldestStrength + (kNewestStrobe - kOldestStrength) * age);
        }
    }
}

void MotionTrails::drawLine(Paint& paint, const PixelView& view, const std::deque<DVec2>& line, Color color) const {
    if (line.empty()) { return; }
    DVec2 last = view.toPixels(line.front());
    for (std::size_t i = 1; i < line.size(); ++i) {
        const DVec2 next = view.toPixels(line[i]);
        const bool newest = i + 1 == line.size();
        // Points closer than a pixel are joined, so that a slow body costs no more triangles than a fast one.
        if (!newest && std::hypot(next.x - last.x, next.y - last.y) < 1) { continue; }
        const double age = static_cast<double>(i) / static_cast<double>(line.size());
        const double strength = kOldestStrength + (kNewestStrength - kOldestStrength) * age;
        paint.line(last, next, 1.6 * view.pen, mix(style::kBackground, color, strength));
        last = next;
    }
}

}  // namespace swept
