#include "render_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "render_outline.h"

namespace swept {

namespace {

constexpr double kMargin = 1.12;  // of a fitted view around its content
// Of a view that moves with a body, against the reach of that: a car has three of its lengths before it in a wide
// picture.
constexpr double kFollowing = 8;

struct WorldBox {
    DVec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    DVec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    bool empty() const { return !(low.x <= high.x); }
    double size() const { return std::max(high.x - low.x, high.y - low.y); }
    void add(DVec2 p, double radius) {
        low = {std::min(low.x, p.x - radius), std::min(low.y, p.y - radius)};
        high = {std::max(high.x, p.x + radius), std::max(high.y, p.y + radius)};
    }
    void add(const WorldBox& other) {
        if (other.empty()) { return; }
        add(other.low, 0);
        add(other.high, 0);
    }
    WorldBox clippedTo(const WorldBox& other) const {
        return {{std::max(low.x, other.low.x), std::max(low.y, other.low.y)},
                {std::min(high.x, other.high.x), std::min(high.y, other.high.y)}};
    }
    double distanceTo(const WorldBox& other) const {
        return std::max({0.0, low.x - other.high.x, other.low.x - high.x, low.y - other.high.y, other.low.y - high.y});
    }
};

WorldBox boxOf(const BodyDescription& body) {
    WorldBox box;
    const double c = std::cos(body.angle);
    const double s = std::sin(body.angle);
    for (const ShapeDescription& shape : body.shapes) {
        const ShapeCore core = shapeCore(shape.geometry, shape.radius);
        for (const DVec2 p : core.points) {
            box.add(body.position + DVec2{c * p.x - s * p.y, s * p.x + c * p.y}, core.radius);
        }
    }
    return box;
}

/// From the origin, metres.
double reachOf(const BodyDescription& body) {
    double reach = 0;
    for (const ShapeDescription& shape : body.shapes) {
        const ShapeCore core = shapeCore(shape.geometry, shape.radius);
        for (const DVec2 p : core.points) { reach = std::max(reach, std::hypot(p.x, p.y) + core.radius); }
    }
    return reach;
}

ViewDescription viewOfScene(const SceneDescription& scene, double aspect) {
    return scene.view ? *scene.view : fittedView(scene, aspect);
}

}  // namespace

PixelPose::PixelPose(const PixelView& view, DVec2 position, double angle)
    : offset_(position - view.center),
      middle_(view.middle),
      cosine_(std::cos(angle)),
      sine_(std::sin(angle)),
      scale_(view.scale),
      pen_(view.pen) {}

ViewDescription fittedView(const SceneDescription& scene, double aspect) {
    WorldBox moving;
    for (const BodyDescription& body : scene.bodies) {
        if (body.type != SceneBodyType::fixed) { moving.add(boxOf(body)); }
    }
    WorldBox all = moving;
    for (const BodyDescription& body : scene.bodies) {
        if (body.type != SceneBodyType::fixed) { continue; }
        const WorldBox box = boxOf(body);
        if (moving.empty() || box.empty() || box.size() <= 25 * moving.size()) {
            all.add(box);
            continue;
        }
        // A ground of a kilometre below a ball: what the ball may reach, not the kilometre.
        const double reach = 1.5 * std::max(box.distanceTo(moving), moving.size());
        WorldBox near;
        near.add(moving.low, reach);
        near.add(moving.high, reach);
        all.add(box.clippedTo(near));
    }
    if (all.empty()) { return {{0, 0}, 10}; }
    const double height = kMargin * std::max(all.high.y - all.low.y, (all.high.x - all.low.x) / aspect);
    return {0.5 * (all.low + all.high), height > 0 ? height : 10};
}

double halfWidthOf(const SceneDescription& scene, const ViewDescription& view, double most) {
    double half = 0;
    for (const BodyDescription& body : scene.bodies) {
        const WorldBox box = boxOf(body);
        if (box.empty()) { continue; }
        const double reach = std::max(box.high.x - view.center.x, view.center.x - box.low.x);
        if (reach <= most) { half = std::max(half, reach); }
    }
    return half;
}

double penScale(const RenderOptions& options) {
    return std::clamp(std::min(options.height / 540.0, options.width / 960.0), 0.7, 4.0);
}

double followingHeight(const SceneDescription& scene, std::size_t body, double aspect) {
    const double most = viewOfScene(scene, aspect).height;
    const double reach = reachOf(scene.bodies[body]);
    return reach > 0 ? std::min(most, kFollowing * reach) : most;
}

PixelView pixelView(const SceneDescription& scene, const RenderOptions& options) {
    const double width = options.width;
    const double height = options.height;
    ViewDescription view;
    if (options.view) {
        view = *options.view;
    } else if (options.follow) {
        view.height = followingHeight(scene, *options.follow, width / height);
    } else {
        view = viewOfScene(scene, width / height);
    }
    if (options.follow) { view.center = view.center + scene.bodies[*options.follow].position; }
    return {view.center, height / view.height, {width / 2, height / 2}, penScale(options)};
}

}  // namespace swept
