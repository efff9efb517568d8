#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <swept/tools/reference/box2d_approximations.h>

namespace swept {
namespace {

bool mentions(const SceneDescription& scene, const std::string& word) {
    const auto sentences = box2dApproximations(scene);
    return std::any_of(sentences.begin(), sentences.end(),
                       [&](const std::string& sentence) { return sentence.find(word) != std::string::npos; });
}

TEST(Box2dApproximations, AlwaysTellsTheWaysOfTheEngine) {
    const SceneDescription empty;
    EXPECT_TRUE(mentions(empty, "skin"));
    EXPECT_TRUE(mentions(empty, "2 m"));
    EXPECT_TRUE(mentions(empty, "Damping"));
    EXPECT_TRUE(mentions(empty, "1 m/s"));
    EXPECT_TRUE(mentions(empty, "Sub-steps"));
}

TEST(Box2dApproximations, TellsOnlyOfWhatTheSceneHolds) {
    SceneDescription scene;
    EXPECT_FALSE(mentions(scene, "Capsules"));
    EXPECT_FALSE(mentions(scene, "Rounded"));
    EXPECT_FALSE(mentions(scene, "Rolling"));
    EXPECT_FALSE(mentions(scene, "Segments do not"));
    EXPECT_FALSE(mentions(scene, "revolute"));
    scene.bodies.resize(1);
    scene.bodies[0].shapes.resize(3);
    scene.bodies[0].shapes[0].geometry = CapsuleGeometry{{DVec2{0, 0}, DVec2{1, 0}}, 0.5};
    scene.bodies[0].shapes[1].geometry = BoxGeometry{{1, 1}, {0, 0}, 0};
    scene.bodies[0].shapes[1].radius = 0.1;
    scene.bodies[0].shapes[1].rollingResistance = 0.1;
    scene.bodies[0].shapes[2].geometry = SegmentGeometry{{DVec2{0, 0}, DVec2{1, 0}}};
    JointDescription joint;
    joint.joint = RevoluteDescription{{0, 0}, {}, {}, {}, {}, {}, {}, 4.0, {}, {}};
    scene.joints = {joint};
    EXPECT_TRUE(mentions(scene, "Capsules"));
    EXPECT_TRUE(mentions(scene, "Rounded"));
    EXPECT_TRUE(mentions(scene, "Rolling"));
    EXPECT_TRUE(mentions(scene, "Segments do not"));
    EXPECT_TRUE(mentions(scene, "revolute"));
    WheelDescription wheel{{0, 0}, {}, {}, {0, 1}, {}, {}, {}, {}, 4.0, {}, {}};
    scene.joints[0].joint = wheel;
    EXPECT_FALSE(mentions(scene, "wheels"));
    wheel.springTarget = 0.1;
    scene.joints[0].joint = wheel;
    EXPECT_TRUE(mentions(scene, "Springs of wheels"));
}

}  // namespace
}  // namespace swept
