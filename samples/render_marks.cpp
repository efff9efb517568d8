#include "render_marks.h"

#include <algorithm>
#include <cmath>

namespace swept {

namespace {

constexpr double kNormalLength = 20;  // pixels
constexpr double kShortestArrow = 3;  // pixels

}  // namespace

void drawContacts(Paint& paint, const PixelView& view, const Frame& frame) {
    for (const ContactFrame& contact : frame.contacts) {
        const DVec2 p = view.toPixels(contact.point);
        if (!isFinite(p) || !isFinite(contact.normal)) {
            continue;
        }
        paint.arrow(p, p + view.pen * kNormalLength * contact.normal, 1.4 * view.pen, style::kContact);
        paint.disc(p, 3.4 * view.pen, rgb(0xFFFFFF));
        paint.disc(p, 2.5 * view.pen, style::kContact);
    }
}

void drawVelocities(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame,
                    double seconds) {
    for (std::size_t i = 0; i < std::min(scene.bodyCount(), frame.bodies.size()); ++i) {
        const BodyFrame& body = frame.bodies[i];
        if (!body.awake || !scene.moves(i)) {
            continue;
        }
        const DVec2 tail = view.toPixels(body.position);
        const DVec2 way = view.scale * seconds * body.velocity;
        if (std::hypot(way.x, way.y) >= kShortestArrow) {
            paint.arrow(tail, tail + way, 1.7 * view.pen, style::kVelocity);
        }
    }
}

void drawImpacts(Paint& paint, const PixelView& view, const SceneDrawing& scene, const Frame& frame) {
    for (const ImpactFrame& impact : frame.impacts) {
        if (impact.body < 0 || static_cast<std::size_t>(impact.body) >= scene.bodyCount()) {
            continue;
        }
        BodyFrame state;
        state.position = impact.position;
        state.angle = impact.angle;
        scene.drawGhost(paint, view, static_cast<std::size_t>(impact.body), state, style::kGhost);
    }
}

}  // namespace swept
