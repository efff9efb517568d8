#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/deviation.h>
#include <swept/tools/reference/box2d_runner.h>

/// Joints that begin half way, turned or apart, mean the same in Box2D.

namespace swept {
namespace {

using build::box;
using build::circle;

constexpr double kHalfOpen = 0.6;  // rad

Frame frameAfter(Runner& runner, int steps) {
    for (int i = 0; i < steps; ++i) { runner.step(); }
    Frame frame;
    runner.read(frame, false);
    return frame;
}

struct Both {
    Frame ours;
    Frame theirs;
};

Both framesAfter(const SceneDescription& scene, int steps) {
    const auto fault = validateScene(scene);
    EXPECT_FALSE(fault.has_value()) << fault->text();
    std::string error;
    const std::unique_ptr<Runner> ours = makeRunner(scene, {.precision = Precision::f64}, error);
    EXPECT_NE(ours, nullptr) << error;
    const auto theirs = makeBox2dRunner(scene, error, {}, SWEPT_PROGRAM);
    EXPECT_NE(theirs, nullptr) << error;
    if (!ours || !theirs) { return {}; }
    return {frameAfter(*ours, steps), frameAfter(*theirs, steps)};
}

/// How far the bodies of both engines are apart: metres and radians.
Deviation deviationAfter(const SceneDescription& scene, int steps = 120) {
    const Both frames = framesAfter(scene, steps);
    return deviationOf(scene, frames.ours, frames.theirs);
}

SceneDescription frameAndDoor() {
    SceneDescription scene = build::scene("door", {0, 0}, 4);
    scene.gravity = {0, 0};
    scene.settings.sleep = false;
    build::addFixed(scene, "frame", {0, 0}, {box({0.1, 0.1})});
    build::addDynamic(scene, "door", {0.5 * std::cos(kHalfOpen), 0.5 * std::sin(kHalfOpen)}, {box({0.5, 0.05})}).angle =
        kHalfOpen;
    return scene;
}

TEST(Box2dJoints, DoorsThatBeginHalfOpen) {
    for (const double speed : {2.0, -2.0}) {
        SceneDescription scene = frameAndDoor();
        RevoluteDescription& hinge = build::hinge(scene, "frame", "door", {0, 0});
        hinge.referenceAngle = 0;
        hinge.lower = 0;
        hinge.upper = 1.5;
        hinge.motorSpeed = speed;
        hinge.maxMotorTorque = 10;
        const Deviation deviation = deviationAfter(scene);
        EXPECT_LT(deviation.worstAngle, 0.05);
        EXPECT_LT(deviation.worstPosition, 0.03);
        scene.bodies[1].angle -= 2 * std::numbers::pi;  // told otherwise, in the same place
        const Deviation turned = deviationAfter(scene);
        EXPECT_LT(turned.worstAngle, 0.05);
        EXPECT_LT(turned.worstPosition, 0.03);
    }
}

TEST(Box2dJoints, SlidersAndWheelsThatBeginOnTheirWay) {
    SceneDescription scene = build::scene("slider", {0, 0}, 6);
    scene.settings.sleep = false;
    build::addFixed(scene, "rail", {0, 0}, {box({0.1, 0.1})});
    build::addDynamic(scene, "sled", {0.3, 0}, {box({0.1, 0.1})}).angle = 0.5;
    build::addDynamic(scene, "wheel", {3, -0.2}, {circle(0.2)});
    PrismaticDescription& slider = build::slider(scene, "rail", "sled", {0, 0}, {1, 0});
    slider.anchorB = DVec2{0.3, 0};
    slider.referenceAngle = 0.5;
    slider.lower = 0;
    slider.upper = 1;
    slider.motorSpeed = 1;
    slider.maxMotorForce = 5;
    WheelDescription& wheel = build::wheel(scene, "rail", "wheel", {3, 0}, {0, 1});
    wheel.anchorB = DVec2{3, -0.2};
    wheel.lower = -0.5;
    wheel.upper = 0.1;
    for (const int steps : {10, 120}) {
        EXPECT_LT(deviationAfter(scene, steps).worstPosition, 0.03) << steps;
        EXPECT_LT(deviationAfter(scene, steps).worstAngle, 0.01) << steps;
    }
}

TEST(Box2dJoints, WeldsThatSnapTogether) {
    SceneDescription scene = build::scene("weld", {0, 0}, 6);
    scene.gravity = {0, 0};
    scene.settings.sleep = false;
    build::addDynamic(scene, "hull", {0, 0}, {box({0.5, 0.5})});
    build::addDynamic(scene, "wing", {1.5, 0.2}, {box({0.5, 0.5})}).angle = 0.4;
    WeldDescription& weld = build::weld(scene, "hull", "wing", {0.5, 0});
    weld.anchorB = DVec2{1.5 - 0.5 * std::cos(0.4), 0.2 - 0.5 * std::sin(0.4)};
    weld.referenceAngle = 0;
    const Deviation deviation = deviationAfter(scene);
    EXPECT_LT(deviation.worstPosition, 0.05);
    EXPECT_LT(deviation.worstAngle, 0.1);
}

TEST(Box2dJoints, MotorsAndGearsCountFromAnglesOfReference) {
    SceneDescription scene = build::scene("drives", {0, 0}, 6);
    scene.gravity = {0, 0};
    scene.settings.sleep = false;
    build::addFixed(scene, "base", {0, 0}, {box({0.1, 0.1})});
    build::addDynamic(scene, "tool", {2, 1}, {box({0.3, 0.2})}).angle = 1.2;
    build::addDynamic(scene, "first", {-1, 0}, {circle(0.4)}).angle = 0.4;
    build::addDynamic(scene, "second", {-2, 0}, {circle(0.2)}).angle = -0.1;
    MotorDescription& motor = build::motor(scene, "base", "tool");
    motor.referenceAngle = 0;
    motor.angularOffset = 0.25;
    motor.maxTorque = 10;
    motor.maxForce = 10;
    RevoluteDescription& hinge = build::hinge(scene, "base", "first", {-1, 0});
    hinge.referenceAngle = 0;
    hinge.lower = 0;
    hinge.upper = 1;
    hinge.motorSpeed = 2;
    hinge.maxMotorTorque = 5;
    const std::string first = build::lastJoint(scene);
    build::hinge(scene, "base", "second", {-2, 0}).referenceAngle = 0;
    build::gear(scene, first, build::lastJoint(scene), 0.5);
    const Deviation deviation = deviationAfter(scene);
    EXPECT_LT(deviation.worstPosition, 0.02);
    EXPECT_LT(deviation.worstAngle, 0.1);
}

/// Drawn tight, or as long as the way is. (Box2D's rope pushes: it has none that is slack.)
TEST(Box2dJoints, RopesOfPulleysHaveTheirLength) {
    constexpr double kHeight = 4;
    SceneDescription scene = build::scene("pulley", {0, 0}, 10);
    scene.settings.sleep = false;
    build::addDynamic(scene, "light", {-1, 0}, {box({0.2, 0.2})});
    build::addDynamic(scene, "heavy", {1, 0}, {box({0.3, 0.3})});
    PulleyDescription& rope = build::pulley(scene, "light", "heavy", {-1, 0}, {1, 0}, kHeight);
    for (const double length : {2 * kHeight, 2 * kHeight - 0.1}) {
        rope.length = length;
        const Both frames = framesAfter(scene, 30);
        for (const Frame* const frame : {&frames.ours, &frames.theirs}) {
            const double found = 2 * kHeight - frame->bodies[0].position.y - frame->bodies[1].position.y;
            EXPECT_NEAR(found, length, 5e-3);
            EXPECT_GT(frame->bodies[0].position.y, 0.3) << "the heavy one falls";
        }
    }
}

}  // namespace
}  // namespace swept
