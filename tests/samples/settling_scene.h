#pragma once

#include <swept/samples/scene_builder.h>

/// A small scene in which every number of the format that has a unit matters within a few seconds: speed limit, TOI
/// tolerance, damping, given mass and inertia, springs, motors, limits, breaking joints, sensors, bodies that fall
/// asleep and are woken again.

namespace swept::test {

inline void addJointed(SceneDescription& scene) {
    using namespace build;
    addDynamic(scene, "spinner", {-6, 3}, {box({0.6, 0.1})}).angularDamping = 0.25;
    RevoluteDescription& motor = hinge(scene, "ground", "spinner", {-6, 3});
    motor.motorSpeed = 3;
    motor.maxMotorTorque = 2;
    BodyDescription& door = addDynamic(scene, "door", {-3, 3}, {box({0.5, 0.05})});
    door.mass = 2.5;
    door.inertia = 0.7;
    RevoluteDescription& spring = hinge(scene, "ground", "door", {-3.5, 3});
    spring.hertz = 2;
    spring.dampingRatio = 0.1;
    spring.lower = -0.3;
    spring.upper = 0.3;
    addDynamic(scene, "bob", {0, 4}, {circle(0.3)}).linearDamping = 0.125;
    DistanceDescription& rubber = rod(scene, "ground", "bob", {0, 6}, {0, 4});
    rubber.hertz = 1.5;
    rubber.dampingRatio = 0.05;
    rubber.minLength = 1.5;
    rubber.maxLength = 3;
    addDynamic(scene, "weight", {3, 4}, {withDensity(circle(0.4), 30)});
    rod(scene, "ground", "weight", {3, 6}, {3, 4});
    scene.joints.back().breakForce = 100;
}

inline SceneDescription settlingScene() {
    using namespace build;
    SceneDescription scene = build::scene("settling", {0, 3}, 12);
    scene.settings.maxSpeed = 40;
    scene.settings.toiTolerance = 0.0001;
    addFixed(scene, "ground", {0, 0}, {chain({{12, 2}, {9, 0.1}, {0, 0}, {-9, 0.1}, {-12, 2}})});
    addJointed(scene);
    addDynamic(scene, "crate", {5, 0.6}, {box({0.5, 0.5})});
    addDynamic(scene, "lid", {5.1, 1.7}, {rounded(box({0.4, 0.4}), 0.05)});
    addDynamic(scene, "sleeper", {7, 0.7}, {box({0.5, 0.5})}).awake = false;
    BodyDescription& bullet = addDynamic(scene, "bullet", {-11, 5}, {withRestitution(circle(0.05), 0.5)});
    bullet.velocity = {90, -20};
    BodyDescription& dart = addDynamic(scene, "dart", {-2, 9}, {capsule({-0.2, 0}, {0.2, 0}, 0.03)});
    dart.velocity = {3, -60};
    dart.angularVelocity = 40;
    dart.continuous = SceneContinuous::stop;
    addKinematic(scene, "piston", {8.5, 1}, {box({0.2, 0.5})}).velocity = {-0.25, 0};
    addFixed(scene, "gate", {5, 1}, {box({1, 1})});
    scene.bodies.back().shapes[0].sensor = true;
    return scene;
}

}  // namespace swept::test
