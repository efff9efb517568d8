#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/deviation.h>
#include <swept/tools/reference/peer_limits.h>
#include <swept/tools/reference/peer_runner.h>

/// Joints mean the same in Box2D 3.

namespace swept {
namespace {

using build::box;
using build::circle;

constexpr double kRailAngle = 0.7;
constexpr double kBarAngle = 0.2;
constexpr DVec2 kAnchor{1, 0.5};
constexpr DVec2 kAxis{0.6, 0.8};

/// In small steps, so that what is left between engines is what they make of the scene.
SceneDescription emptyScene() {
    SceneDescription scene = build::scene("joints", {0, 0}, 4);
    scene.gravity = {0, -10};
    scene.settings.sleep = false;
    scene.settings.dt = 1.0 / 240;
    return scene;
}

/// A fixed body and one that moves, both turned.
SceneDescription railAndBar() {
    SceneDescription scene = emptyScene();
    build::addFixed(scene, "rail", {0, 0}, {box({0.1, 0.1})}).angle = kRailAngle;
    build::addDynamic(scene, "bar", kAnchor, {box({0.3, 0.2})}).angle = kBarAngle;
    return scene;
}

Frame endOf(Runner& runner, int steps) {
    for (int i = 0; i < steps; ++i) { runner.step(); }
    Frame frame;
    runner.read(frame, false);
    return frame;
}

class Box2d3Joints : public testing::Test {
protected:
    void SetUp() override {
        if (!hasPeer(PeerEngine::box2d3)) { GTEST_SKIP() << "Box2D 3 was not found as this was built"; }
    }

    /// After half a second its bodies are where ours are.
    /// @return how ours are then
    static Frame expectAlike(const SceneDescription& scene, double within = 3e-3) {
        constexpr int kSteps = 120;
        const auto fault = validateScene(scene);
        EXPECT_FALSE(fault.has_value()) << fault->text();
        std::string error;
        const auto ours = makeRunner(scene, {.precision = Precision::f64}, error);
        PeerSettings stiff;
        stiff.engine = PeerEngine::box2d3;
        stiff.subSteps = 16;
        stiff.isStiff = 1;
        const auto theirs = makePeerRunner(scene, stiff, error, SWEPT_PROGRAM);
        if (!ours || !theirs) {
            ADD_FAILURE() << error;
            return {};
        }
        Frame frame = endOf(*ours, kSteps);
        const Deviation deviation = deviationOf(scene, frame, endOf(*theirs, kSteps));
        EXPECT_LT(deviation.worstPosition, within);
        EXPECT_LT(deviation.worstAngle, within);
        return frame;
    }
};

TEST_F(Box2d3Joints, SliderOnASpringSwingsAlongItsAxis) {
    SceneDescription scene = railAndBar();
    PrismaticDescription& slider = build::slider(scene, "rail", "bar", kAnchor, kAxis);
    slider.hertz = 1.5;
    slider.dampingRatio = 0.2;
    slider.springTarget = 0.5;
    const BodyFrame bar = expectAlike(scene).bodies[1];
    EXPECT_GT(length(bar.position - kAnchor), 0.1) << "it hardly moved";
    EXPECT_NEAR(cross(kAxis, bar.position - kAnchor), 0, 1e-6);
}

TEST_F(Box2d3Joints, SliderBeginsOnItsWay) {
    SceneDescription scene = railAndBar();
    PrismaticDescription& slider = build::slider(scene, "rail", "bar", kAnchor - 0.3 * kAxis, 3 * kAxis);
    slider.anchorB = kAnchor;
    slider.referenceAngle = kBarAngle - kRailAngle;
    slider.hertz = 1;
    slider.dampingRatio = 0;
    slider.lower = -0.1;
    const BodyFrame bar = expectAlike(scene).bodies[1];
    EXPECT_NEAR(bar.angle, kBarAngle, 1e-6);
}

TEST_F(Box2d3Joints, SliderTurnsToItsReferenceAngle) {
    SceneDescription scene = railAndBar();
    build::slider(scene, "rail", "bar", kAnchor, kAxis).referenceAngle = kBarAngle - kRailAngle + 0.1;
    scene.gravity = {0, 0};
    EXPECT_NEAR(expectAlike(scene).bodies[1].angle, kBarAngle + 0.1, 1e-3);
}

TEST_F(Box2d3Joints, SliderKeepsItsLimitsAndTheSpeedOfItsMotor) {
    for (const bool hasMotor : {false, true}) {
        SceneDescription scene = railAndBar();
        PrismaticDescription& slider = build::slider(scene, "rail", "bar", kAnchor, kAxis);
        slider.lower = -0.4;
        if (hasMotor) {
            slider.motorSpeed = 2;
            slider.maxMotorForce = 1000;
        }
        const BodyFrame bar = expectAlike(scene, 0.01).bodies[1];
        EXPECT_NEAR(dot(kAxis, bar.position - kAnchor), hasMotor ? 1 : -0.4, 0.01);
    }
}

TEST_F(Box2d3Joints, WheelOfACarTurnsAndIsSprung) {
    SceneDescription scene = emptyScene();
    build::addDynamic(scene, "chassis", {0, 2}, {box({1, 0.25})}).angularVelocity = 1;
    build::addDynamic(scene, "wheel", {0.8, 1.6}, {circle(0.3)}).velocity = {0, 1};
    WheelDescription& wheel = build::wheel(scene, "chassis", "wheel", {0.8, 1.6}, {0.1, 1});
    wheel.hertz = 3;
    wheel.dampingRatio = 0.3;
    wheel.motorSpeed = -20;
    wheel.maxMotorTorque = 2;
    const Frame frame = expectAlike(scene, 0.01);
    EXPECT_LT(frame.bodies[1].angle, -4) << "it hardly turned";
}

TEST_F(Box2d3Joints, MotorJointMovesAlongTheAxesOfItsFirstBody) {
    SceneDescription scene = railAndBar();
    MotorDescription& motor = build::motor(scene, "rail", "bar");
    motor.linearVelocity = DVec2{1, 0};
    motor.angularVelocity = 2;
    motor.maxForce = 50;
    motor.maxTorque = 5;
    const BodyFrame bar = expectAlike(scene, 0.01).bodies[1];
    EXPECT_NEAR(bar.position.x, kAnchor.x + 0.5 * std::cos(kRailAngle), 0.02);
    EXPECT_NEAR(bar.angle, kBarAngle + 1, 0.02);
}

TEST_F(Box2d3Joints, MotorJointWithoutTorqueLeavesTheAngleAlone) {
    SceneDescription scene = railAndBar();
    scene.bodies[1].angularVelocity = 3;
    MotorDescription& motor = build::motor(scene, "rail", "bar");
    motor.linearVelocity = DVec2{0, 0};
    motor.maxForce = 1;  // slower than it falls
    const BodyFrame bar = expectAlike(scene).bodies[1];
    EXPECT_NEAR(bar.angle, kBarAngle + 1.5, 1e-6);
}

/// The first body is there in name only, even where it could be pulled.
TEST_F(Box2d3Joints, MousePullsTheSecondBodyAlone) {
    for (const bool isFirstFixed : {true, false}) {
        SceneDescription scene = railAndBar();
        scene.bodies[0].type = isFirstFixed ? SceneBodyType::fixed : SceneBodyType::dynamic;
        MouseDescription& mouse = build::mouse(scene, "rail", "bar", kAnchor + DVec2{0.5, 0.5});
        mouse.anchor = kAnchor + DVec2{0.2, 0.1};
        mouse.hertz = 2;
        mouse.dampingRatio = 0.3;
        mouse.maxForce = 1000;
        const Frame frame = expectAlike(scene, 0.01);
        EXPECT_GT(length(frame.bodies[1].position - kAnchor), 0.1) << "it hardly moved";
    }
}

TEST_F(Box2d3Joints, MouseWithoutASpringHoldsItsPoint) {
    SceneDescription scene = railAndBar();
    build::mouse(scene, "rail", "bar", kAnchor + DVec2{0.2, 0.1}).maxForce = 1000;
    expectAlike(scene, 0.01);
}

TEST_F(Box2d3Joints, FilterLetsBodiesPass) {
    SceneDescription scene = railAndBar();
    scene.bodies[1].position = {0, 0.5};
    build::keepApart(scene, "rail", "bar");
    EXPECT_LT(expectAlike(scene, 0.02).bodies[1].position.y, -0.5);
}

TEST_F(Box2d3Joints, WhatItLacksIsNamed) {
    SceneDescription scene = railAndBar();
    const auto lack = [&] { return peerLacks(PeerEngine::box2d3, scene); };
    MotorDescription& motor = build::motor(scene, "rail", "bar");
    motor.maxForce = 1;
    EXPECT_EQ(lack(), "motor joints to a pose");
    motor.linearVelocity = DVec2{1, 0};
    EXPECT_EQ(lack(), "");
    motor.maxTorque = 1;
    EXPECT_EQ(lack(), "motor joints to a pose");
    scene.joints.clear();
    build::wheel(scene, "rail", "bar", kAnchor, kAxis).springTarget = 1;
    EXPECT_EQ(lack(), "wheel joints whose spring has a target");
    scene.joints.clear();
    build::pulley(scene, "rail", "bar", {0, 0}, kAnchor, 3);
    EXPECT_EQ(lack(), "pulley joints");
    scene.joints.clear();
    build::gear(scene, "one", "two", 1);
    EXPECT_EQ(lack(), "gear joints");
}

}  // namespace
}  // namespace swept
