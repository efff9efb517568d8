#include "../scene_builder.h"
#include "builtin_scenes.h"

/// Surfaces that run: belts that carry, and a body that moves on its own track.

namespace swept::scenes {
namespace {

using namespace build;

ShapeDescription belt(ShapeDescription shape, double speed) {
    shape.surfaceSpeed = speed;
    return shape;
}

/// Two slanting walls without friction, and what waits between them.
void addHopper(SceneDescription& scene, DVec2 outlet) {
    std::vector<ShapeDescription> walls{box({0.08, 0.9}, {-1.35, 0.75}, 0.75), box({0.08, 0.9}, {1.35, 0.75}, -0.75),
                                        box({0.08, 1}, {-1.95, 2.3}), box({0.08, 1}, {1.95, 2.3})};
    for (ShapeDescription& wall : walls) { wall.friction = 0; }
    addFixed(scene, "hopper", outlet, std::move(walls));
    Dice dice(5);
    for (int i = 0; i < 36; ++i) {
        const DVec2 place = outlet + DVec2{-1.4 + 0.56 * (i % 6) + dice.range(-0.04, 0.04), 1.5 + 0.45 * (i / 6)};
        const double size = dice.range(0.13, 0.2);
        switch (i % 3) {
            case 0:
                addDynamic(scene, "", place, {box({size, size})});
                break;
            case 1:
                addDynamic(scene, "", place, {circle(size)});
                break;
            default:
                addDynamic(scene, "", place, {capsule({-0.12, 0}, {0.12, 0}, 0.8 * size)});
        }
    }
}

/// A tracked body, heavy enough for its edges to hold on to steps.
void addCrawler(SceneDescription& scene, DVec2 place) {
    const ShapeDescription hull = polygon({{-0.5, -0.2}, {0.5, -0.2}, {0.75, 0.1}, {-0.75, 0.1}});
    addDynamic(scene, "crawler", place, {belt(withFriction(withDensity(rounded(hull, 0.1), 3), 1.5), 0.3)});
}

}  // namespace

SceneDescription conveyors() {
    SceneDescription scene = build::scene("conveyors", {0, 3.5}, 10);
    addHopper(scene, {-4.9, 5.5});
    addFixed(scene, "upper belt", {-2.6, 4.5}, {belt(rounded(box({3.6, 0.05}), 0.15), 1.5)});
    BodyDescription& slope = addFixed(scene, "sloping belt", {2, 2.5}, {belt(rounded(box({3, 0.05}), 0.15), -1.5)});
    slope.angle = -0.2;
    addFixed(scene, "ground", {0, 0}, {belt(chain({{7.4, 2.4}, {7.4, 0}, {-7.4, 0}, {-7.4, 2.4}}), 1.2)});
    std::vector<ShapeDescription> steps{box({0.1, 0.9}, {2.4, 0.9})};
    for (int i = 0; i < 4; ++i) { steps.push_back(box({2.5 - 0.4 * i, 0.07}, {0.4 * i, 0.14 * i})); }
    addFixed(scene, "steps", {5, 5}, std::move(steps));
    addCrawler(scene, {3.4, 5.55});
    return scene;
}

}  // namespace swept::scenes
