#pragma once

#include <string>

#include <swept/samples/scene_builder.h>

namespace swept::scenes {

/// Five links on a string, thrown together.
inline void throwChain(SceneDescription& scene, const std::string& name, DVec2 from, DVec2 velocity) {
    using namespace build;
    for (int i = 0; i < 5; ++i) {
        const std::string link = name + std::to_string(i);
        addDynamic(scene, link, from + DVec2{0.5 * i, 0}, {box({0.25, 0.1})}).velocity = velocity;
        if (i > 0) { hinge(scene, name + std::to_string(i - 1), link, from + DVec2{0.5 * i - 0.25, 0}); }
    }
}

/// Everything at once: piles that sleep and that do not, chains thrown at walls and at each other, a motor, bullets,
/// bouncing flyers, a sensor, a paddle that turns.
inline SceneDescription mixedScene() {
    using namespace build;
    SceneDescription scene = build::scene("mixed", {0, 8}, 24);
    addFixed(scene, "ground", {0, -0.5}, {box({30, 0.5}), box({0.5, 20}, {-20, 0}), box({0.5, 20}, {20, 0})});
    for (int i = 0; i < 40; ++i) {
        addDynamic(scene, "", {-14 + i / 8 * 1.2, 0.5 + i % 8}, {box({0.5, 0.5})});
        addDynamic(scene, "", {4 + i / 8 * 1.2, 0.5 + i % 8}, {box({0.5, 0.5})}).awake = false;
    }
    throwChain(scene, "left", {-8, 5}, {-70, 5});
    throwChain(scene, "right", {12, 12}, {60, 0});
    throwChain(scene, "down", {-4, 15}, {30, -80});
    addDynamic(scene, "wheel", {0, 2}, {circle(1)});
    RevoluteDescription& drive = hinge(scene, "ground", "wheel", {0, 2});
    drive.motorSpeed = 30;
    drive.maxMotorTorque = 500;
    addKinematic(scene, "paddle", {2, 6}, {box({2, 0.1})}).angularVelocity = 15;
    addFixed(scene, "gate", {-16, 3}, {box({1, 3})});
    scene.bodies.back().shapes[0].sensor = true;
    Dice dice(3);
    for (int i = 0; i < 24; ++i) {
        BodyDescription& ball =
            addDynamic(scene, "", {dice.range(-18, 18), dice.range(9, 18)}, {withRestitution(circle(0.2), 0.9)});
        ball.velocity = {dice.range(-90, 90), dice.range(-90, 90)};
        ball.bullet = i % 4 == 0;
    }
    return scene;
}

}  // namespace swept::scenes
