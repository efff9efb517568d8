#include "render_chain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace swept {

namespace {

constexpr double kBand = 13;       // pixels
constexpr double kHatchStep = 9;   // pixels along the chain
constexpr double kHatchDepth = 6;  // pixels
constexpr double kLongestMiter = 2;
constexpr std::uint8_t kBandAlpha = 92;

DVec2 leftOf(DVec2 p, DVec2 q) {
    const DVec2 along = q - p;
    const double size = std::hypot(along.x, along.y);
    return size > 0 ? 1 / size * DVec2{-along.y, along.x} : DVec2{};
}

/// Where the bands of two edges meet: to the left of their vertex, per pixel of depth.
DVec2 miter(DVec2 before, DVec2 after) {
    const DVec2 sum = before + after;
    const double size = dot(sum, sum);
    if (size < 1e-6) { return after; }  // a hairpin has no left side to share
    const DVec2 exact = 2 / size * sum;
    const double longest = std::hypot(exact.x, exact.y);
    return std::min(1.0, kLongestMiter / longest) * exact;
}

void hatch(Paint& paint, DVec2 p, DVec2 along, DVec2 left, double walked, double visible, Color color, double pen) {
    const double step = kHatchStep * pen;
    const double first = step - std::fmod(walked, step);
    for (double s = first; s < visible; s += step) {
        const DVec2 foot = p + s * along;
        paint.line(foot, foot + pen * kHatchDepth * (left - along), pen, color);
    }
}

}  // namespace

void shadeSolidSide(Paint& paint, std::span<const DVec2> points, bool loop, Color color, double pen) {
    const std::size_t count = points.size();
    if (count < 2 || !std::all_of(points.begin(), points.end(), isFinite)) { return; }
    const std::size_t edges = loop ? count : count - 1;
    const PixelBox near = paint.box().grownBy(kLongestMiter * kBand * pen);
    const auto normal = [&](std::size_t edge) { return leftOf(points[edge % count], points[(edge + 1) % count]); };
    double walked = 0;
    for (std::size_t i = 0; i < edges; ++i) {
        const DVec2 p = points[i];
        const DVec2 q = points[(i + 1) % count];
        const double size = std::hypot(q.x - p.x, q.y - p.y);
        const VisiblePart part = clipSegment(p, q, near);
        if (size > 0 && std::isfinite(size) && part.from < part.to) {
            const DVec2 left = normal(i);
            const bool joinsBefore = part.from == 0 && (loop || i > 0);
            const bool joinsAfter = part.to == 1 && (loop || i + 1 < edges);
            const DVec2 leftAtP = joinsBefore ? miter(normal(i + count - 1), left) : left;
            const DVec2 leftAtQ = joinsAfter ? miter(left, normal(i + 1)) : left;
            const DVec2 a = p + part.from * (q - p);
            const DVec2 b = p + part.to * (q - p);
            paint.fillGradient(a, b, a + pen * kBand * leftAtP, b + pen * kBand * leftAtQ, withAlpha(color, kBandAlpha),
                               withAlpha(color, 0));
            hatch(paint, a, 1 / size * (q - p), left, walked + part.from * size, (part.to - part.from) * size, color,
                  pen);
        }
        walked = std::fmod(walked + size, kHatchStep * pen);
    }
}

}  // namespace swept
