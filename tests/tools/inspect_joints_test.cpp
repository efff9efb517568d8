#include <gtest/gtest.h>

#include <optional>
#include <string>

#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/inspect/inspect_scene.h>

#include "inspect_support.h"

/// What the scene doctor finds in joints.

namespace swept {
namespace {

using namespace inspect_test;
using build::box;
using build::circle;

TEST(InspectJoints, FindsHeavyLoadsOnChains) {
    SceneDescription scene = build::scene("chain", {0, 0}, 10);
    build::addFixed(scene, "hook", {0, 0}, {circle(0.1)});
    build::addDynamic(scene, "link", {0, -1}, {circle(0.1)});
    build::addDynamic(scene, "ball", {0, -3}, {build::withDensity(circle(1), 100)});
    build::hinge(scene, "hook", "link", {0, 0});
    build::hinge(scene, "link", "ball", {0, -1});
    EXPECT_TRUE(inspectScene(scene).findings.empty()) << "ten thousand to one swings well";
    scene.settings.profile = SceneProfile::fast;
    expectOnly(scene, "mass-ratio", "/bodies/2");
    scene.settings = {};
    scene.bodies[2].shapes = {build::withDensity(circle(1), 1e5)};
    expectOnly(scene, "mass-ratio", "/bodies/2");
}

TEST(InspectJoints, NeedsGoByMotorsAndPairsThatMayTouch) {
    SceneDescription scene = build::scene("wheel", {0, 0}, 10);
    build::addFixed(scene, "axle", {0, 0}, {circle(0.1)});
    build::addDynamic(scene, "wheel", {0, 0}, {circle(0.5)});
    RevoluteDescription& hinge = build::hinge(scene, "axle", "wheel", {0, 0});
    EXPECT_FALSE(needs(inspectScene(scene), "continuous collision"));
    EXPECT_FALSE(needs(inspectScene(scene), "friction")) << "the joint keeps them apart";
    hinge.motorSpeed = 100;
    EXPECT_TRUE(needs(inspectScene(scene), "continuous collision"));
    build::addFixed(scene, "ground", {0, -1}, {box({5, 0.5})});
    EXPECT_TRUE(needs(inspectScene(scene), "friction"));
}

TEST(InspectJoints, FindsJointsThatStartViolatedOrCannotBeMet) {
    SceneDescription scene = build::scene("rods", {0, 0}, 10);
    build::addFixed(scene, "left", {-2, 0}, {circle(0.1)});
    build::addFixed(scene, "right", {2, 0}, {circle(0.1)});
    build::addDynamic(scene, "ball", {0, -1}, {circle(0.2)});
    build::rod(scene, "left", "ball", {-2, 0}, {0, -1});
    EXPECT_TRUE(inspectScene(scene).findings.empty());
    build::rod(scene, "right", "ball", {2, 0}, {0, -1}).length = 1;
    const Inspection inspection = inspectScene(scene);
    EXPECT_EQ(countOf(inspection, "joint-violated", "/joints/1"), 1);
    EXPECT_EQ(countOf(inspection, "joint-impossible", "/joints/1"), 1);  // 1 + √5 < 4
    SceneDescription idle = soundScene();
    build::addFixed(idle, "post", {5, 3}, {circle(0.1)});
    build::rod(idle, "ground", "post", {5, 0}, {5, 3}).length = 2;
    EXPECT_EQ(countOf(inspectScene(idle), "joint-idle", "/joints/0"), 1);
    EXPECT_EQ(countOf(inspectScene(idle), "joint-impossible", "/joints/0"), 1);
}

TEST(InspectJoints, FindsLimitsThatExcludeTheStart) {
    SceneDescription scene = soundScene();
    scene.bodies[1].position.y = 2;
    build::hinge(scene, "ground", "crate", {0, 2}).lower = 0.5;
    expectOnly(scene, "joint-violated", "/joints/0");
}

TEST(InspectJoints, KnowsWhereJointsBegin) {
    SceneDescription scene = soundScene();
    scene.bodies[1].position.y = 2;
    RevoluteDescription& hinge = build::hinge(scene, "ground", "crate", {0, 2});
    hinge.lower = 0.5;
    hinge.referenceAngle = -1;
    EXPECT_TRUE(inspectScene(scene).findings.empty()) << "at 1 rad";
    hinge.referenceAngle = 1;
    expectOnly(scene, "joint-violated", "/joints/0");
    hinge.referenceAngle.reset();
    hinge.lower.reset();
    hinge.anchorB = DVec2{0.3, 2};
    expectOnly(scene, "joint-violated", "/joints/0");
    PrismaticDescription slider;
    slider.anchor = {0, 2};
    slider.axis = {1, 0};
    slider.anchorB = DVec2{0.3, 2};
    slider.lower = 0.1;
    scene.joints[0].joint = slider;
    EXPECT_TRUE(inspectScene(scene).findings.empty()) << "on its way";
    slider.anchorB = DVec2{0.3, 2.3};
    scene.joints[0].joint = slider;
    expectOnly(scene, "joint-violated", "/joints/0");
}

TEST(InspectJoints, FindsLimitsOfSlidersAndWheelsThatExcludeTheStart) {
    const auto expectViolated = [](const auto& limited) {
        SceneDescription scene = soundScene();
        JointDescription& joint = scene.joints.emplace_back();
        joint.bodyA = "ground";
        joint.bodyB = "crate";
        joint.joint = limited;
        const Inspection inspection = inspectScene(scene);
        EXPECT_EQ(countOf(inspection, "joint-violated", "/joints/0"), limited.upper < 0 ? 1 : 0);
    };
    const DVec2 place = soundScene().bodies[1].position;
    PrismaticDescription slider;
    WheelDescription wheel;
    slider.anchor = wheel.anchor = place;
    slider.axis = wheel.axis = {0, 1};
    for (const double upper : {-0.5, 0.5}) {
        slider.lower = wheel.lower = -1;
        slider.upper = wheel.upper = upper;
        expectViolated(slider);
        expectViolated(wheel);
    }
}

TEST(InspectJoints, FindsJointsTooWeakForWhatHangsOnThem) {
    SceneDescription scene = soundScene();
    scene.bodies[1].position.y = 2;  // the crate
    JointDescription& hook = scene.joints.emplace_back();
    hook.bodyA = "ground";
    hook.bodyB = "crate";
    RevoluteDescription hinge;
    hinge.anchor = {0, 2};
    hook.joint = hinge;
    hook.breakForce = 1e6;
    EXPECT_EQ(countOf(inspectScene(scene), "joint-weak", "/joints/0"), 0);
    hook.breakForce = 1e-3;
    EXPECT_EQ(countOf(inspectScene(scene), "joint-weak", "/joints/0"), 1);
    hook.breakForce.reset();
    MouseDescription mouse;
    mouse.target = {0, 2};
    mouse.maxForce = 1e-3;
    hook.joint = mouse;
    EXPECT_EQ(countOf(inspectScene(scene), "joint-weak", "/joints/0"), 1);
    scene.joints.push_back(JointDescription(hook));  // two share the weight
    EXPECT_EQ(countOf(inspectScene(scene), "joint-weak", "/joints/0"), 0);
}

/// What is advised to be set is accepted, and then there is nothing to find.
TEST(InspectJoints, AdviceOnRodsThatStartViolatedIsAccepted) {
    const auto sceneWith = [](const DistanceDescription& rope) {
        SceneDescription scene = build::scene("rope", {0, 0}, 10);
        build::addFixed(scene, "hook", {0, 4}, {circle(0.1)});
        build::addDynamic(scene, "ball", {0, 0}, {circle(0.2)});
        build::rod(scene, "hook", "ball", {0, 4}, {0, 0}) = rope;
        return scene;
    };
    DistanceDescription rope;
    rope.anchorA = {0, 4};
    const auto expectAdvice = [&](DistanceDescription given, const std::string& member,
                                  std::optional<double> DistanceDescription::*wanted) {
        ASSERT_FALSE(validateScene(sceneWith(given)));
        const std::string advice = remedyOf(sceneWith(given), "joint-violated");
        EXPECT_NE(advice.find("or set \"" + member + "\": 4"), std::string::npos) << advice;
        given.*wanted = 4;
        EXPECT_FALSE(validateScene(sceneWith(given)));
        EXPECT_TRUE(inspectScene(sceneWith(given)).findings.empty());
    };
    DistanceDescription tooShort = rope;
    tooShort.maxLength = 2;
    expectAdvice(tooShort, "maxLength", &DistanceDescription::maxLength);
    DistanceDescription tooLong = rope;
    tooLong.minLength = 6;
    expectAdvice(tooLong, "minLength", &DistanceDescription::minLength);
    DistanceDescription stiff = rope;
    stiff.length = 3;
    expectAdvice(stiff, "length", &DistanceDescription::length);
}

}  // namespace
}  // namespace swept
