#include <gtest/gtest.h>

#include <numbers>

#include <swept/samples/render/render_view.h>

#include "render_support.h"

namespace swept::test {
namespace {

TEST(RenderView, CountsTheBodiesThatAreWholeWithinReach) {
    const ViewDescription view{{1, 0}, 4};
    SceneDescription scene;
    EXPECT_EQ(halfWidthOf(scene, view, 10), 0);
    scene.bodies = {makeBody(SceneBodyType::dynamic, {3, 0}, circle(0.5)),
                    makeBody(SceneBodyType::fixed, {0, 0}, box(100, 1)),
                    makeBody(SceneBodyType::kinematic, {-4, 7}, box(1, 0.25))};
    EXPECT_EQ(halfWidthOf(scene, view, 10), 6);
    EXPECT_EQ(halfWidthOf(scene, view, 5), 2.5) << "the box is seen in part at most";
    EXPECT_EQ(halfWidthOf(scene, view, 1000), 101);
    scene.bodies[2].angle = std::numbers::pi / 2;
    EXPECT_NEAR(halfWidthOf(scene, view, 10), 5.25, 1e-9);
}

}  // namespace
}  // namespace swept::test
