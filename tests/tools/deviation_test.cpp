#include <gtest/gtest.h>

#include <swept/tools/deviation.h>

namespace swept {
namespace {

SceneDescription threeBodies() {
    SceneDescription scene;
    scene.bodies.resize(3);
    scene.bodies[1].type = SceneBodyType::dynamic;
    scene.bodies[2].type = SceneBodyType::dynamic;
    return scene;
}

TEST(Deviation, ComparesDynamicBodies) {
    Frame ours;
    ours.step = 7;
    ours.time = 0.5;
    ours.bodies = {{{9, 9}, 0, {}, 0, false}, {{0, 0}, 1, {1, 0}, 0, true}, {{3, 4}, 0, {0, 0}, 0, true}};
    Frame theirs = ours;
    theirs.bodies[0].position = {0, 0};
    theirs.bodies[1].angle = 1.5;
    theirs.bodies[1].velocity = {1, 2};
    theirs.bodies[2].position = {0, 0};
    const Deviation deviation = deviationOf(threeBodies(), ours, theirs);
    EXPECT_EQ(deviation.step, 7);
    EXPECT_EQ(deviation.time, 0.5);
    ASSERT_EQ(deviation.bodies.size(), 2u);
    EXPECT_EQ(deviation.worstPosition, 5);
    EXPECT_EQ(deviation.worstBody, 2);
    EXPECT_EQ(deviation.meanPosition, 2.5);
    EXPECT_EQ(deviation.worstAngle, 0.5);
    EXPECT_EQ(deviation.bodies[0].velocity, 2);
}

TEST(Deviation, OfASceneWithoutDynamicBodiesIsNone) {
    SceneDescription scene;
    scene.bodies.resize(1);
    Frame frame;
    frame.bodies.resize(1);
    const Deviation deviation = deviationOf(scene, frame, frame);
    EXPECT_EQ(deviation.worstBody, -1);
    EXPECT_EQ(deviation.meanPosition, 0);
    EXPECT_EQ(visibleDeviation(scene), 0);
}

TEST(Deviation, IsVisibleFromATenthOfTheSmallestBodyOn) {
    SceneDescription scene = threeBodies();
    ShapeDescription shape;
    shape.geometry = CircleGeometry{{0, 0}, 0.001};
    scene.bodies[0].shapes = {shape};  // static: does not count
    shape.geometry = CircleGeometry{{5, 0}, 2};
    scene.bodies[1].shapes = {shape};
    shape.geometry = BoxGeometry{{1, 0.1}, {0, 0}, 0};
    shape.radius = 0.5;
    scene.bodies[2].shapes = {shape};
    EXPECT_NEAR(visibleDeviation(scene), 0.3, 1e-15);
}

}  // namespace
}  // namespace swept
