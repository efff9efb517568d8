#include "render_belt.h"

#include <algorithm>
#include <cmath>

namespace swept {

namespace {

constexpr double kStep = 26;   // pixels from one arrowhead to the next
constexpr double kDepth = 5;   // pixels from the outline
constexpr double kLength = 4;  // pixels
constexpr double kHalfWidth = 2.5;

void arrowhead(Paint& paint, DVec2 tip, DVec2 ahead, Color color, double pen) {
    const DVec2 side = pen * kHalfWidth * DVec2{-ahead.y, ahead.x};
    const DVec2 back = tip - pen * kLength * ahead;
    paint.line(back + side, tip, 1.3 * pen, color);
    paint.line(back - side, tip, 1.3 * pen, color);
}

/// From 0 to less than `step`.
double remainderOf(double x, double step) {
    const double rest = std::fmod(x, step);
    return rest < 0 ? rest + step : rest;
}

}  // namespace

void markBelt(Paint& paint, std::span<const DVec2> points, bool loop, double way, bool isForward, Color color,
              double pen) {
    const std::size_t count = points.size();
    if (count < 2 || !std::all_of(points.begin(), points.end(), isFinite) || !std::isfinite(way)) { return; }
    const double step = kStep * pen;
    const PixelBox near = paint.box().grownBy(step);
    double walked = 0;  // modulo a step
    for (std::size_t i = 0; i < (loop ? count : count - 1); ++i) {
        const DVec2 p = points[i];
        const DVec2 edge = points[(i + 1) % count] - p;
        const double size = std::hypot(edge.x, edge.y);
        if (!(size > 0) || !std::isfinite(size)) { continue; }
        const DVec2 along = 1 / size * edge;
        const DVec2 inwards{-along.y, along.x};
        const VisiblePart part = clipSegment(p, p + edge, near);
        const double begin = part.from * size;
        for (double s = begin + remainderOf(way - walked - begin, step); s < part.to * size; s += step) {
            arrowhead(paint, p + s * along + pen * kDepth * inwards, isForward ? along : -1 * along, color, pen);
        }
        walked = remainderOf(walked + size, step);
    }
}

}  // namespace swept
