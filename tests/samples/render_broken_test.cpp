#include <gtest/gtest.h>

#include <memory>
#include <span>
#include <string>

#include "render_support.h"

// Joints that broke: those are gone from pictures, and no others.

namespace swept::test {
namespace {

using Type = SceneBodyType;

TEST(RenderBroken, OfTwoJointsBetweenOnePairTheOneThatHoldsStays) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::fixed, {0, 2}, box(0.2, 0.05)), makeBody(Type::dynamic, {0, 0}, circle(0.2))};
    for (const double x : {-1.0, 1.0}) {
        JointDescription joint;
        joint.bodyA = "body0";
        joint.bodyB = "body1";
        RevoluteDescription revolute;
        revolute.anchor = {x, 0};
        joint.joint = revolute;
        scene.joints.push_back(joint);
    }
    const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, bareOptions());
    const Frame frame = initialFrame(scene);
    SceneEvent broken;
    broken.type = SceneEventType::jointBreak;
    broken.a = 0;
    broken.b = 1;
    broken.joint = 1;
    renderer->removeBrokenJoints(std::span(&broken, 1));
    EXPECT_EQ(pixelAt(renderer->draw(frame), {0.5, 0}), style::kBackground);
    EXPECT_LT(pixelAt(renderer->draw(frame), {-0.5, 0}).red, 200) << "the arm of the other one";
}

TEST(RenderBroken, AGearGoesWithEitherOfItsJoints) {
    SceneDescription scene;
    scene.bodies = {makeBody(Type::fixed, {0, 2}, box(0.2, 0.05)), makeBody(Type::dynamic, {-1, 0}, circle(0.2)),
                    makeBody(Type::dynamic, {1, 0}, circle(0.2))};
    for (const int i : {1, 2}) {
        JointDescription joint;
        joint.name = "hinge" + std::to_string(i);
        joint.bodyA = "body0";
        joint.bodyB = "body" + std::to_string(i);
        RevoluteDescription revolute;
        revolute.anchor = scene.bodies[static_cast<std::size_t>(i)].position;
        joint.joint = revolute;
        scene.joints.push_back(joint);
    }
    JointDescription gear;
    gear.bodyA = "body1";
    gear.bodyB = "body2";
    gear.joint = GearDescription{"hinge1", "hinge2", 1};
    scene.joints.push_back(gear);
    const auto isLineDrawn = [](const Image& image) {
        int drawn = 0;  // the line of a gear is dashed
        for (double x = -0.7; x < 0.7; x += 0.005) { drawn += pixelAt(image, {x, 0}) == style::kBackground ? 0 : 1; }
        return drawn > 20;
    };
    for (const int lost : {0, 1}) {
        const std::unique_ptr<SceneRenderer> renderer = makeRenderer(scene, bareOptions());
        EXPECT_TRUE(isLineDrawn(renderer->draw(initialFrame(scene))));
        SceneEvent broken;
        broken.type = SceneEventType::jointBreak;
        broken.joint = lost;
        renderer->removeBrokenJoints(std::span(&broken, 1));
        EXPECT_FALSE(isLineDrawn(renderer->draw(initialFrame(scene)))) << lost;
    }
}

}  // namespace
}  // namespace swept::test
