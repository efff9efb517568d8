#include "render_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

namespace swept {

namespace {

constexpr double kChordTolerance = 0.05;  // pixels
constexpr int kMaxArcDepth = 40;          // halvings: below, neighbouring doubles of an angle

struct Arc {
    DVec2 center;
    double radius = 0;
    const PixelBox& box;
    std::vector<DVec2>& out;

    DVec2 at(double angle) const { return center + radius * DVec2{std::cos(angle), std::sin(angle)}; }

    /// Adds the points after `from` up to `to` (at most a quarter turn).
    void add(double from, double to, int depth) const {
        const DVec2 p = at(from);
        const DVec2 q = at(to);
        const double quarter = std::sin((to - from) / 4);
        const double sagitta = 2 * radius * quarter * quarter;
        const PixelBox around{{std::min(p.x, q.x) - sagitta, std::min(p.y, q.y) - sagitta},
                              {std::max(p.x, q.x) + sagitta, std::max(p.y, q.y) + sagitta}};
        const bool visible = around.low.x <= box.high.x && around.high.x >= box.low.x && around.low.y <= box.high.y &&
                             around.high.y >= box.low.y;
        if (sagitta < kChordTolerance || !visible || depth == kMaxArcDepth) {
            out.push_back(q);
            return;
        }
        const double middle = 0.5 * (from + to);
        add(from, middle, depth + 1);
        add(middle, to, depth + 1);
    }

    void addTurn(double from, double turn) const {
        const int quarters = std::max(1, static_cast<int>(std::ceil(turn / (std::numbers::pi / 2) - 1e-9)));
        out.push_back(at(from));
        for (int i = 0; i < quarters; ++i) { add(from + turn * i / quarters, from + turn * (i + 1) / quarters, 0); }
    }
};

struct CoreMaker {
    double radius;

    ShapeCore operator()(const BoxGeometry& box) const {
        const double c = std::cos(box.angle);
        const double s = std::sin(box.angle);
        const std::array<DVec2, 4> corners{{{-box.half.x, -box.half.y},
                                            {box.half.x, -box.half.y},
                                            {box.half.x, box.half.y},
                                            {-box.half.x, box.half.y}}};
        ShapeCore core{{}, radius};
        for (const DVec2 p : corners) {
            core.points.push_back(box.center + DVec2{c * p.x - s * p.y, s * p.x + c * p.y});
        }
        return core;
    }
    ShapeCore operator()(const CircleGeometry& circle) const { return {{circle.center}, circle.radius}; }
    ShapeCore operator()(const CapsuleGeometry& capsule) const {
        return {{capsule.points[0], capsule.points[1]}, capsule.radius};
    }
    ShapeCore operator()(const SegmentGeometry& segment) const {
        return {{segment.points[0], segment.points[1]}, radius};
    }
    ShapeCore operator()(const PolygonGeometry& polygon) const { return {convexHull(polygon.points), radius}; }
    ShapeCore operator()(const ChainGeometry& chain) const { return {chain.points, radius}; }
};

}  // namespace

ShapeCore shapeCore(const Geometry& geometry, double radius) { return std::visit(CoreMaker{radius}, geometry); }

std::vector<DVec2> convexHull(std::vector<DVec2> points) {
    std::sort(points.begin(), points.end(), [](DVec2 a, DVec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) { return points; }
    std::vector<DVec2> hull;
    const auto addSide = [&hull](auto first, auto last) {  // Andrew's monotone chain: one side, without its last point
        const std::size_t start = hull.size();
        for (auto it = first; it != last; ++it) {
            while (hull.size() >= start + 2 && cross(hull.back() - hull[hull.size() - 2], *it - hull.back()) <= 0) {
                hull.pop_back();
            }
            hull.push_back(*it);
        }
        hull.pop_back();
    };
    addSide(points.begin(), points.end());
    addSide(points.rbegin(), points.rend());
    return hull;
}

double narrowestWidth(const ShapeCore& core) {
    if (core.points.size() < 3) { return 2 * core.radius; }
    double narrowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < core.points.size(); ++i) {
        const DVec2 edge = core.points[(i + 1) % core.points.size()] - core.points[i];
        const double size = std::hypot(edge.x, edge.y);
        if (!(size > 0)) { continue; }
        double width = 0;
        for (const DVec2 p : core.points) { width = std::max(width, cross(1 / size * edge, p - core.points[i])); }
        narrowest = std::min(narrowest, width);
    }
    return (std::isfinite(narrowest) ? narrowest : 0) + 2 * core.radius;
}

std::vector<DVec2> roundedOutline(const ShapeCore& core, const PixelBox& box) {
    std::vector<DVec2> out;
    const std::size_t count = core.points.size();
    if (count == 1) {
        Arc{core.points[0], core.radius, box, out}.addTurn(0, 2 * std::numbers::pi);
        return out;
    }
    if (!(core.radius > 0)) { return core.points; }
    for (std::size_t i = 0; i < count; ++i) {
        const DVec2 before = core.points[i] - core.points[(i + count - 1) % count];
        const DVec2 after = core.points[(i + 1) % count] - core.points[i];
        // The outward normal is the edge turned clockwise. Both ends of a capsule turn by half a circle: the sign of a
        // cross product of zero must not decide.
        const double turn = std::atan2(count == 2 ? 0.0 : std::max(0.0, cross(before, after)), dot(before, after));
        Arc{core.points[i], core.radius, box, out}.addTurn(std::atan2(-before.x, before.y), turn);
    }
    return out;
}

ShapeCore insetCore(const ShapeCore& core, double depth, const PixelBox& box) {
    if (depth <= core.radius) { return {core.points, core.radius - depth}; }
    if (core.points.size() < 3) { return {}; }
    ShapeCore inner{core.points, 0};
    const double cut = depth - core.radius;
    // Cut what is visible, not what is there: a corner 10^17 pixels away cannot be moved by one pixel.
    clipToBox(inner.points, box.grownBy(4 * depth));
    for (std::size_t i = 0; i < core.points.size(); ++i) {
        const DVec2 p = core.points[i];
        const DVec2 edge = core.points[(i + 1) % core.points.size()] - p;
        const double size = std::hypot(edge.x, edge.y);
        if (!(size > 0)) { continue; }
        const DVec2 along = 1 / size * edge;
        cutLeftOf(inner.points, p + cut * DVec2{-along.y, along.x}, -along);
    }
    return inner;
}

}  // namespace swept
