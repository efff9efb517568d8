#include "../scene_builder.h"
#include "builtin_scenes.h"

/// What discrete engines lose: the fast, the thin and the small.

namespace swept::scenes {

using namespace build;

SceneDescription bulletCurtain() {
    constexpr int kRows = 9;
    SceneDescription scene = build::scene("bullet curtain", {0, 3.9}, 10);
    addFixed(scene, "floor", {0, 0}, {box({8.2, 0.2}, {0, -0.2}), box({8.2, 0.05}, {0, 4})});
    addFixed(scene, "thin wall", {3, 2}, {box({0.005, 1.95})});            // 1 cm
    addFixed(scene, "line wall", {5, 0}, {segment({0, 4.05}, {0, 8.4})});  // no thickness at all
    // Two closed rooms: who rebounds has further walls to respect.
    addFixed(scene, "shell", {-8, 0}, {segment({0, 0}, {0, 8.4}), segment({0, 8.4}, {13, 8.4})});
    for (int i = 0; i < 2 * kRows; ++i) {
        const int row = i % kRows;
        const double y = 0.4 + 0.38 * row + (i < kRows ? 0.0 : 4.2);
        const ShapeDescription kinds[] = {circle(0.1), box({0.16, 0.07}), capsule({-0.13, 0}, {0.13, 0}, 0.05)};
        const ShapeDescription shape = withRestitution(withDensity(kinds[row % 3], 5), 0.4);
        BodyDescription& bullet = addDynamic(scene, "", {-7.5, y}, {shape});
        bullet.velocity = {25.0 * static_cast<double>(1 << (row % 7)), 0};  // 25, 50, … 1600 m/s
        bullet.bullet = true;
    }
    return scene;
}

namespace {

/// One step of this shows what a mode does: a ball, a capsule and a spinning bar meet a wall of 2 cm, and a ball passes
/// by the corner of a post that it does not touch.
SceneDescription thinWall(const std::string& name, SceneContinuous mode) {
    constexpr std::uint32_t kPasserBy = 2;  ///< the only one whom the post may meet
    SceneDescription scene = build::scene(name, {-0.6, -0.1}, 3.05);
    scene.gravity = {0, 0};
    scene.settings.continuous = mode;
    addFixed(scene, "wall", {0, 0}, {box({0.01, 1.45}, {0, -0.1})});
    ShapeDescription post = box({0.13, 0.13});
    post.filter.mask = kPasserBy;
    addFixed(scene, "post", {-0.85, 0.6}, {post});
    const auto shoot = [&scene](const char* shot, double y, DVec2 velocity, double spin, ShapeDescription shape) {
        BodyDescription& body =
            addDynamic(scene, shot, {-1.45, y}, {withRestitution(withFriction(std::move(shape), 0.2), 0.7)});
        body.velocity = velocity;
        body.angularVelocity = spin;
        body.shapes[0].filter.group = -1;  // they do not see each other
    };
    shoot("passer-by", 0.88, {66, 0}, 0, circle(0.1));
    scene.bodies.back().shapes[0].filter.category = kPasserBy;
    shoot("ball", 0.2, {125, 0}, 0, circle(0.12));
    shoot("capsule", -0.35, {110, -12}, 0, capsule({-0.14, 0}, {0.14, 0}, 0.06));
    shoot("bar", -1.05, {100, 0}, 110, box({0.3, 0.025}));
    return scene;
}

}  // namespace

SceneDescription continuousOff() { return thinWall("continuous: off", SceneContinuous::off); }
SceneDescription continuousSpeedLimit() { return thinWall("continuous: speedLimit", SceneContinuous::speedLimit); }
SceneDescription continuousSpeculative() { return thinWall("continuous: speculative", SceneContinuous::speculative); }
SceneDescription continuousStop() { return thinWall("continuous: stop", SceneContinuous::stop); }
SceneDescription continuousSubStep() { return thinWall("continuous: subStep", SceneContinuous::subStep); }

SceneDescription spinningBars() {
    SceneDescription scene = build::scene("spinning bars", {0, 4}, 10.6);
    addFixed(scene, "tray", {0, 0}, {box({7.4, 0.2}, {0, -0.2}), box({0.2, 2}, {-7.2, 2}), box({0.2, 2}, {7.2, 2})});
    std::vector<ShapeDescription> pins;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 8; ++column) {
            const double shift = row % 2 == 0 ? 0.0 : 0.85;
            pins.push_back(circle(0.08, {1.7 * (column - 3.5) + shift - 0.425, 1.6 + 1.2 * row}));
        }
    }
    addFixed(scene, "pins", {0, 0}, std::move(pins));
    for (int i = 0; i < 8; ++i) {
        const double x = 1.5 * (i - 3.5);
        const double y = i % 2 == 0 ? 7.2 : 8.4;
        const double length = 0.55 + 0.05 * (i % 3);
        BodyDescription& bar = addDynamic(scene, "bar" + std::to_string(i), {x, y}, {box({length, 0.03})});
        bar.angularVelocity = (i % 2 == 0 ? 1 : -1) * (18.0 + 6 * i);
        bar.velocity = {0, -4};
        bar.bullet = true;  // their tips move by ten times their thickness in a step
        bar.shapes[0].restitution = 0.3;
    }
    return scene;
}

SceneDescription slenderAndTiny() {
    SceneDescription scene = build::scene("slender and tiny", {0, 0.2}, 0.57);
    addFixed(scene, "table", {0, 0},
             {box({0.45, 0.01}, {0, -0.01}), box({0.005, 0.03}, {-0.445, 0.03}), box({0.005, 0.03}, {0.445, 0.03})});
    addFixed(scene, "shelf", {0, 0}, {segment({-0.3, 0.16}, {-0.05, 0.12}), segment({0.05, 0.12}, {0.3, 0.16})});
    for (int i = 0; i < 6; ++i) {  // rods 14 cm long and 2 mm thick, upright: they topple
        addDynamic(scene, "rod" + std::to_string(i), {-0.2 + 0.08 * i, 0.235 + 0.01 * i}, {box({0.001, 0.07})});
        scene.bodies.back().angularVelocity = i % 2 == 0 ? 0.4 : -0.4;
    }
    Dice dice(5);
    for (int i = 0; i < 60; ++i) {  // shot of 4 mm
        const DVec2 place{-0.29 + 0.02 * (i % 30), 0.37 + 0.03 * static_cast<double>(i / 30)};
        addDynamic(scene, "", place, {circle(0.002)}).velocity = {dice.range(-0.1, 0.1), dice.range(-2, 0)};
    }
    for (int i = 0; i < 3; ++i) {  // slivers: triangles that are a hundred times longer than high
        addDynamic(scene, "sliver" + std::to_string(i), {-0.3 + 0.3 * i, 0.43},
                   {polygon({{-0.1, 0}, {0.1, 0}, {0, 0.002}})})
            .angularVelocity = 3;
    }
    return scene;
}

}  // namespace swept::scenes
