#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <string>

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

TEST(RenderView, OfABodyIsAFewTimesItsReachHigh) {
    SceneDescription scene;
    scene.bodies = {makeBody(SceneBodyType::fixed, {0, 0}, box(100, 1)),
                    makeBody(SceneBodyType::dynamic, {3, 0}, BoxGeometry{{0.25, 0}, {0.25, 0}, 0}, 0.5),
                    BodyDescription{}};
    scene.view = ViewDescription{{0, 0}, 12};
    EXPECT_EQ(followingHeight(scene, 1, 2), 8) << "1 m from the origin, its rounding included";
    EXPECT_EQ(followingHeight(scene, 0, 2), 12) << "no more than the scene shows";
    EXPECT_EQ(followingHeight(scene, 2, 2), 12) << "without shapes";
    scene.view.reset();
    EXPECT_EQ(followingHeight(scene, 0, 2), fittedView(scene, 2).height);
}

/// What a camera beside a body sees does not depend on where the two are.
TEST(RenderView, MovesWithTheBodyThatItFollows) {
    SceneDescription scene;
    scene.bodies = {makeBody(SceneBodyType::dynamic, {0, 0}, box(0.5, 0.25)),
                    makeBody(SceneBodyType::dynamic, {-1, 1}, circle(0.25))};
    RenderOptions options = bareOptions();
    options.view->center = {1, 0.5};
    const Image still = picture(scene, options);
    options.follow = 0;
    const auto renderer = makeRenderer(scene, options);
    EXPECT_EQ(renderer->view().center, (DVec2{1, 0.5}));
    Frame frame = initialFrame(scene);
    EXPECT_TRUE(renderer->draw(frame) == still);
    for (const DVec2 way : {DVec2{3, -2}, DVec2{0x1p30, -0x1p29}, DVec2{-0x1p30, 0x1p29}}) {
        for (BodyFrame& body : frame.bodies) { body.position += way; }
        EXPECT_TRUE(renderer->draw(frame) == still) << way.x;
    }
    frame.bodies[1].position.x += 0.25;
    EXPECT_FALSE(renderer->draw(frame) == still) << "the other body moves in the picture";
}

TEST(RenderView, StaysWhereTheBodyThatItFollowsIsLost) {
    SceneDescription scene;
    scene.bodies = {makeBody(SceneBodyType::dynamic, {4, 0}, circle(0.5))};
    RenderOptions options = bareOptions();
    options.view.reset();
    options.follow = 0;
    const auto renderer = makeRenderer(scene, options);
    EXPECT_EQ(renderer->view().center, (DVec2{4, 0}));
    EXPECT_EQ(renderer->view().scale, options.height / followingHeight(scene, 0, 960.0 / 540));
    Frame frame = initialFrame(scene);
    frame.bodies[0].position = {5, 1};
    (void)renderer->draw(frame);
    frame.bodies[0].position.x = std::numeric_limits<double>::quiet_NaN();
    (void)renderer->draw(frame);
    frame.bodies.clear();
    (void)renderer->draw(frame);
    EXPECT_EQ(renderer->view().center, (DVec2{5, 1}));
}

TEST(RenderView, FollowsNobodyWhoIsNotThere) {
    RenderOptions options = bareOptions();
    options.follow = 0;
    std::string error;
    EXPECT_EQ(SceneRenderer::create({}, options, error), nullptr);
    EXPECT_EQ(error, "the body to follow is none of the scene");
}

}  // namespace
}  // namespace swept::test
