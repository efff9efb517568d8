#include "render_marks.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "render_style.h"
#include "stroke_font.h"

namespace swept {

namespace {

constexpr double kNormalLength = 20;  // pixels
constexpr double kShortestArrow = 3;  // pixels

constexpr double kHitLength = 30;     // pixels
constexpr double kLabelHeight = 2.4;  // above the body's origin, in heights of a letter

BodyFrame stateOf(const PoseFrame& pose) {
    BodyFrame state;
    state.position = pose.position;
    state.angle = pose.angle;
    state.awake = true;
    return state;
}

/// Slow motion is not shown: its sweep would be but a thick edge.
constexpr double kLeastWay = 6;  // pixels

bool isShown(const PixelView& view, const SceneDrawing& scene, const WayFrame& way) {
    if (way.body < 0 || static_cast<std::size_t>(way.body) >= scene.bodyCount() || way.poses.size() < 2) {
        return false;
    }
    for (const PoseFrame& pose : way.poses) {
        if (!isFinite(pose.position) || !std::isfinite(pose.angle)) { return false; }
    }
    const DVec2 moved = view.toPixels(way.poses.back().position) - view.toPixels(way.poses.front().position);
    return way.poses.size() > 2 || way.lostSeconds > 0 || std::hypot(moved.x, moved.y) > kLeastWay * view.pen;
}

}  // namespace

void drawSweptAreas(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame) {
    for (const WayFrame& way : frame.ways) {
        if (!isShown(view, scene, way)) { continue; }
        for (std::size_t i = 1; i < way.poses.size(); ++i) {
            scene.drawSwept(paint, view, static_cast<std::size_t>(way.body), stateOf(way.poses[i - 1]),
                            stateOf(way.poses[i]));
        }
    }
}

void drawSweptPoses(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame) {
    for (const WayFrame& way : frame.ways) {
        if (!isShown(view, scene, way)) { continue; }
        const auto body = static_cast<std::size_t>(way.body);
        const DVec2 start = view.toPixels(way.poses.front().position);
        DVec2 last = start;
        for (std::size_t i = 1; i < way.poses.size(); ++i) {
            const DVec2 next = view.toPixels(way.poses[i].position);
            paint.line(last, next, 1.1 * view.pen, scene.styleOf(body, true).edge);
            last = next;
        }
        paint.disc(start, 2.6 * view.pen, scene.styleOf(body, true).edge);
        for (std::size_t i = 1; i + 1 < way.poses.size(); ++i) {
            scene.drawGhost(paint, view, body, stateOf(way.poses[i]), style::kGhost);
        }
    }
    for (const HitFrame& hit : frame.hits) {
        const DVec2 p = view.toPixels(hit.point);
        if (!isFinite(p) || !isFinite(hit.normal)) { continue; }
        paint.arrow(p, p + view.pen * kHitLength * hit.normal, 1.7 * view.pen, style::kContact);
        paint.disc(p, 2.6 * view.pen, style::kContact);
    }
}

void drawLostTimes(Paint& paint, const PixelView& view, const Frame& frame, double textHeight) {
    for (const WayFrame& way : frame.ways) {
        if (way.poses.empty()) { continue; }
        const DVec2 p = view.toPixels(way.poses.back().position);
        if (!(way.lostSeconds > 0) || !isFinite(p) || !paint.box().contains(p)) { continue; }
        const std::string text = "lost " + fixedDecimals(1000 * way.lostSeconds, 1) + " ms";
        const double width = textWidth(text, textHeight);
        const DVec2 low = p + DVec2{-width / 2, kLabelHeight * textHeight};
        paint.fillBox({low - DVec2{4, 4}, low + DVec2{width + 4, textHeight + 4}}, 3, withAlpha(rgb(0xFFFFFF), 200));
        drawText(paint, text, low, textHeight, style::kWarning);
    }
}

void drawContacts(Paint& paint, const PixelView& view, const Frame& frame) {
    for (const ContactFrame& contact : frame.contacts) {
        const DVec2 p = view.toPixels(contact.point);
        if (!isFinite(p) || !isFinite(contact.normal)) { continue; }
        paint.arrow(p, p + view.pen * kNormalLength * contact.normal, 1.4 * view.pen, style::kContact);
        paint.disc(p, 3.4 * view.pen, rgb(0xFFFFFF));
        paint.disc(p, 2.5 * view.pen, style::kContact);
    }
}

void drawVelocities(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame,
                    double seconds) {
    for (std::size_t i = 0; i < std::min(scene.bodyCount(), frame.bodies.size()); ++i) {
        const BodyFrame& body = frame.bodies[i];
        if (!body.awake || !scene.moves(i)) { continue; }
        const DVec2 tail = view.toPixels(body.position);
        const DVec2 way = view.scale * seconds * body.velocity;
        if (std::hypot(way.x, way.y) >= kShortestArrow) {
            paint.arrow(tail, tail + way, 1.7 * view.pen, style::kVelocity);
        }
    }
}

void drawImpacts(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame) {
    for (const ImpactFrame& impact : frame.impacts) {
        if (impact.body < 0 || static_cast<std::size_t>(impact.body) >= scene.bodyCount()) { continue; }
        BodyFrame state;
        state.position = impact.position;
        state.angle = impact.angle;
        scene.drawGhost(paint, view, static_cast<std::size_t>(impact.body), state, style::kGhost);
    }
}

}  // namespace swept
