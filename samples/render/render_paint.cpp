#include "render_paint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render_outline.h"

namespace swept {

namespace {

/// Beyond it products of coordinates would overflow; no picture can tell the difference.
constexpr double kFarthest = 1e100;
/// What is clipped is clipped a little outside of the picture, where its cut edges do not show.
constexpr double kClipMargin = 8;
/// Sides of a small disc: enough for the largest deviation from a circle to stay below a twentieth of a pixel.
constexpr double kDiscTolerance = 0.05;
/// Wider discs and lines are clipped: most of them is out of sight, and numbers of sides and pixels get out of hand.
constexpr double kLargestPen = 16384;

DVec2 clamped(DVec2 p) { return {std::clamp(p.x, -kFarthest, kFarthest), std::clamp(p.y, -kFarthest, kFarthest)}; }

bool allFinite(std::span<const DVec2> points) { return std::all_of(points.begin(), points.end(), isFinite); }

DVec2 normalOf(DVec2 p, DVec2 q) {
    const DVec2 along = q - p;
    const double size = std::hypot(along.x, along.y);
    return size > 0 ? DVec2{-along.y / size, along.x / size} : DVec2{0, 1};
}

/// Keeps what lies above (`side` 1) or below (`side` −1) of a coordinate. The cut is exactly there, however far away
/// the ends of an edge are: interpolation alone would lose it in their last digits.
void cutAtCoordinate(std::vector<DVec2>& points, double DVec2::*axis, double bound, double side) {
    std::vector<DVec2> kept;
    kept.reserve(points.size() + 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DVec2 a = points[i];
        const DVec2 b = points[(i + 1) % points.size()];
        const double depthA = side * (a.*axis - bound);
        const double depthB = side * (b.*axis - bound);
        if (depthA >= 0) { kept.push_back(a); }
        if ((depthA < 0 && depthB > 0) || (depthA > 0 && depthB < 0)) {
            DVec2 cut = a + depthA / (depthA - depthB) * (b - a);
            cut.*axis = bound;
            kept.push_back(cut);
        }
    }
    points.swap(kept);
}

/// Narrows the visible part to `distance + t · slope >= 0`.
void narrow(VisiblePart& part, double distance, double slope) {
    if (slope == 0) {
        if (distance < 0) { part = {}; }
        return;
    }
    const double crossing = -distance / slope;
    if (slope > 0) {
        part.from = std::max(part.from, crossing);
    } else {
        part.to = std::min(part.to, crossing);
    }
}

}  // namespace

Color mix(Color from, Color to, double amount) {
    const auto channel = [amount](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + amount * (b - a)));
    };
    return {channel(from.red, to.red), channel(from.green, to.green), channel(from.blue, to.blue),
            channel(from.alpha, to.alpha)};
}

VisiblePart clipSegment(DVec2 p, DVec2 q, const PixelBox& box) {
    VisiblePart part{0, 1};
    narrow(part, p.x - box.low.x, q.x - p.x);
    narrow(part, box.high.x - p.x, p.x - q.x);
    narrow(part, p.y - box.low.y, q.y - p.y);
    narrow(part, box.high.y - p.y, p.y - q.y);
    return part;
}

void cutLeftOf(std::vector<DVec2>& points, DVec2 p, DVec2 direction) {
    std::vector<DVec2> kept;
    kept.reserve(points.size() + 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DVec2 a = points[i];
        const DVec2 b = points[(i + 1) % points.size()];
        const double sideA = cross(direction, a - p);
        const double sideB = cross(direction, b - p);
        if (sideA <= 0) { kept.push_back(a); }
        if ((sideA < 0 && sideB > 0) || (sideA > 0 && sideB < 0)) {
            kept.push_back(a + sideA / (sideA - sideB) * (b - a));
        }
    }
    points.swap(kept);
}

void clipToBox(std::vector<DVec2>& points, const PixelBox& box) {
    bool inside = true;
    for (DVec2& p : points) {
        p = clamped(p);
        inside = inside && box.contains(p);
    }
    if (inside) { return; }
    cutAtCoordinate(points, &DVec2::x, box.low.x, 1);
    cutAtCoordinate(points, &DVec2::x, box.high.x, -1);
    cutAtCoordinate(points, &DVec2::y, box.low.y, 1);
    cutAtCoordinate(points, &DVec2::y, box.high.y, -1);
}

Paint::Paint(int width, int height) : box_{{0, 0}, {static_cast<double>(width), static_cast<double>(height)}} {}

void Paint::add(DVec2 p, Color color) {
    triangles_.push_back({static_cast<float>(p.x), static_cast<float>(p.y), color});
}

void Paint::triangle(DVec2 a, DVec2 b, DVec2 c, Color color) {
    add(a, color);
    add(b, color);
    add(c, color);
}

void Paint::fillConvex(std::span<const DVec2> outline, Color color) {
    if (outline.size() < 3 || !allFinite(outline)) { return; }
    clipped_.assign(outline.begin(), outline.end());
    clipToBox(clipped_, box_.grownBy(kClipMargin));
    for (std::size_t i = 2; i < clipped_.size(); ++i) { triangle(clipped_[0], clipped_[i - 1], clipped_[i], color); }
}

void Paint::fillGradient(DVec2 p, DVec2 q, DVec2 pFar, DVec2 qFar, Color color, Color farColor) {
    add(p, color);
    add(q, color);
    add(qFar, farColor);
    add(p, color);
    add(qFar, farColor);
    add(pFar, farColor);
}

void Paint::fillBox(const PixelBox& box, double cornerRadius, Color color) {
    constexpr int kSteps = 8;
    const double radius = std::min({cornerRadius, (box.high.x - box.low.x) / 2, (box.high.y - box.low.y) / 2});
    const PixelBox core = box.grownBy(-radius);
    const std::array<DVec2, 4> corners{core.high, {core.low.x, core.high.y}, core.low, {core.high.x, core.low.y}};
    std::vector<DVec2> outline;
    for (int i = 0; i < 4; ++i) {
        for (int step = 0; step <= kSteps; ++step) {
            const double angle = (i + static_cast<double>(step) / kSteps) * std::numbers::pi / 2;
            outline.push_back(corners[static_cast<std::size_t>(i)] + radius * DVec2{std::cos(angle), std::sin(angle)});
        }
    }
    fillConvex(outline, color);
}

void Paint::disc(DVec2 center, double radius, Color color) {
    if (!isFinite(center) || !box_.grownBy(radius).contains(center)) { return; }
    if (radius > kLargestPen) {
        const ShapeCore whole{{clamped(center)}, std::min(radius, kFarthest)};
        fillConvex(roundedOutline(whole, box_.grownBy(kClipMargin)), color);
        return;
    }
    const int sides =
        std::max(8, static_cast<int>(std::ceil(std::numbers::pi * std::sqrt(radius / (2 * kDiscTolerance)))));
    DVec2 last = center + DVec2{radius, 0};
    for (int i = 1; i <= sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        const DVec2 next = center + radius * DVec2{std::cos(angle), std::sin(angle)};
        triangle(center, last, next, color);
        last = next;
    }
}

void Paint::line(DVec2 p, DVec2 q, double width, Color color) {
    if (!isFinite(p) || !isFinite(q)) { return; }
    p = clamped(p);
    q = clamped(q);
    const VisiblePart part = clipSegment(p, q, box_.grownBy(kClipMargin + width));
    if (part.from >= part.to) { return; }
    const DVec2 side = width / 2 * normalOf(p, q);
    const DVec2 a = p + part.from * (q - p);
    const DVec2 b = p + part.to * (q - p);
    if (width > kLargestPen) {
        const std::array<DVec2, 4> band{a + side, a - side, b - side, b + side};
        fillConvex(band, color);
        return;
    }
    triangle(a + side, a - side, b - side, color);
    triangle(a + side, b - side, b + side, color);
}

void Paint::polyline(std::span<const DVec2> points, bool closed, double width, Color color) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        disc(points[i], width / 2, color);
        const std::size_t next = i + 1 < points.size() ? i + 1 : 0;
        if (next != 0 || closed) { line(points[i], points[next], width, color); }
    }
}

void Paint::dashed(std::span<const DVec2> points, bool closed, double width, double dash, double gap, Color color) {
    if (!allFinite(points)) { return; }
    const double period = dash + gap;
    double walked = 0;  // along the outline, so that dashes run on around its corners
    const std::size_t edges = closed ? points.size() : points.size() - std::min<std::size_t>(1, points.size());
    for (std::size_t i = 0; i < edges; ++i) {
        const DVec2 p = clamped(points[i]);
        const DVec2 q = clamped(points[(i + 1) % points.size()]);
        const double size = std::hypot(q.x - p.x, q.y - p.y);
        const VisiblePart part = clipSegment(p, q, box_.grownBy(kClipMargin + width));
        if (size > 0 && part.from < part.to) {
            const double start = part.from * size;
            const double visible = (part.to - part.from) * size;
            const double phase = std::fmod(walked + start, period);
            for (int k = 0; k * period - phase < visible; ++k) {
                const double from = start + std::max(0.0, k * period - phase);
                const double to = start + std::min(visible, k * period - phase + dash);
                if (from < to) { line(p + from / size * (q - p), p + to / size * (q - p), width, color); }
            }
        }
        walked = std::fmod(walked + size, period);
    }
}

void Paint::arrow(DVec2 tail, DVec2 tip, double width, Color color) {
    const double size = std::hypot(tip.x - tail.x, tip.y - tail.y);
    if (!(size > 0) || !std::isfinite(size)) { return; }
    const DVec2 along = 1 / size * (tip - tail);
    const DVec2 side{-along.y, along.x};
    const double head = std::min(4.5 * width, size / 2);
    const DVec2 neck = tip - head * along;
    line(tail, neck, width, color);
    const std::array<DVec2, 3> triangleOfHead{tip, neck + 0.45 * head * side, neck - 0.45 * head * side};
    fillConvex(triangleOfHead, color);
}

}  // namespace swept
