#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>

#include "precision_name.h"

/// What touches at the poses that a frame shows, and how deep bodies are in each other there.

namespace swept::test {
namespace {

constexpr double kPi = std::numbers::pi;

class PresentContacts : public testing::TestWithParam<Precision> {
protected:
    std::unique_ptr<Runner> runnerOf(const SceneDescription& scene) const {
        RunnerOptions options;
        options.precision = GetParam();
        options.measure = true;
        std::string error;
        std::unique_ptr<Runner> runner = makeRunner(scene, options, error);
        EXPECT_NE(runner, nullptr) << error;
        return runner;
    }
    static Frame frameOf(const Runner& runner) {
        Frame frame;
        runner.read(frame, true);
        return frame;
    }
};

/// A box of 1 m on a floor whose top is y = 0.
SceneDescription boxOnFloor(DVec2 position, DVec2 velocity) {
    SceneDescription scene = build::scene("box", {0, 0}, 10);
    build::addFixed(scene, "floor", {0, 0}, {build::box({100, 0.5}, {0, -0.5})});
    build::addDynamic(scene, "box", position, {build::withFriction(build::box({0.5, 0.5}), 0)}).velocity = velocity;
    return scene;
}

TEST_P(PresentContacts, AreUnderABoxThatSlides) {
    const auto runner = runnerOf(boxOnFloor({0, 0.5}, {30, 0}));
    for (int step = 0; step < 10; ++step) { ASSERT_TRUE(runner->step()); }
    const Frame frame = frameOf(*runner);
    ASSERT_EQ(frame.contacts.size(), 2u);
    for (const ContactFrame& contact : frame.contacts) {
        EXPECT_NEAR(std::fabs(contact.point.x - frame.bodies[1].position.x), 0.5, 1e-3);
        EXPECT_NEAR(contact.point.y, 0, 1e-3);
        EXPECT_NEAR(contact.normal.y, 1, 1e-6) << "from the floor to the box";
    }
}

TEST_P(PresentContacts, AreNoneOfWhatIsOnlyNear) {
    const auto runner = runnerOf(boxOnFloor({0, 0.6}, {0, 0}));
    EXPECT_TRUE(frameOf(*runner).contacts.empty());
    ASSERT_TRUE(runner->step());
    EXPECT_TRUE(frameOf(*runner).contacts.empty()) << "the step looks ahead, the picture does not";
}

TEST_P(PresentContacts, AreThereAtTheStart) {
    EXPECT_EQ(frameOf(*runnerOf(boxOnFloor({0, 0.5}, {0, 0}))).contacts.size(), 2u);
}

TEST_P(PresentContacts, TellTheDepthAtTheEndOfTheLastStep) {
    SceneDescription scene = boxOnFloor({0, 1}, {0, -45});
    scene.gravity = {};
    scene.settings.continuous = SceneContinuous::off;
    scene.bodies[0].shapes[0] = build::box({100, 5}, {0, -5});
    const auto runner = runnerOf(scene);
    EXPECT_EQ(runner->report().deepestPenetration, 0);
    EXPECT_FALSE(runner->report().deepestPair);
    ASSERT_TRUE(runner->step());  // by 0.75 m, into the floor by 0.25 m
    const RunReport report = runner->report();
    EXPECT_NEAR(report.deepestPenetration, 0.25, 1e-5);
    ASSERT_TRUE(report.deepestPair);
    EXPECT_EQ(report.deepestPair->a, 0);
    EXPECT_EQ(report.deepestPair->b, 1);
    EXPECT_DOUBLE_EQ(report.deepestPair->time, scene.settings.dt);
}

TEST_P(PresentContacts, TellTheDepthAtTheStart) {
    const RunReport report = runnerOf(boxOnFloor({0, 0.375}, {0, 0}))->report();
    EXPECT_NEAR(report.deepestPenetration, 0.125, 1e-6);
    ASSERT_TRUE(report.deepestPair);
    EXPECT_EQ(report.deepestPair->time, 0);
}

TEST_P(PresentContacts, LeaveOutWhatDoesNotCollide) {
    SceneDescription scene = boxOnFloor({0, 0.375}, {0, 0});
    scene.bodies[1].shapes[0].filter.mask = 0;
    EXPECT_TRUE(frameOf(*runnerOf(scene)).contacts.empty());
    scene.bodies[0].shapes[0].filter.group = scene.bodies[1].shapes[0].filter.group = 1;
    EXPECT_EQ(frameOf(*runnerOf(scene)).contacts.size(), 2u) << "of one group, whatever their masks";
    scene.bodies[0].shapes[0].sensor = true;
    EXPECT_TRUE(frameOf(*runnerOf(scene)).contacts.empty());
    scene.bodies[0].shapes[0].sensor = false;
    build::hinge(scene, "floor", "box", {0, 0});
    EXPECT_TRUE(frameOf(*runnerOf(scene)).contacts.empty()) << "their joint keeps them apart";
    scene.joints[0].collideConnected = true;
    EXPECT_EQ(frameOf(*runnerOf(scene)).contacts.size(), 2u);
}

/// A box slides through a valley, in whose lowest point two chains meet that know of each other: as on one chain.
TEST_P(PresentContacts, AreThoseOfOneChainWhereChainsGoOnAsOthers) {
    const auto slide = [](const std::vector<ShapeDescription>& ground) {
        SceneDescription scene = build::scene("valley", {0, -10}, 10);
        build::addFixed(scene, "ground", {0, 0}, ground);
        build::addDynamic(scene, "box", {-3, 1.2}, {build::withFriction(build::box({0.3, 0.3}), 0)});
        return scene;
    };
    ShapeDescription left = build::chain({{0, 0}, {-4, 1}});
    ShapeDescription right = build::chain({{4, 1}, {0, 0}});
    std::get<ChainGeometry>(left.geometry).before = DVec2{4, 1};
    std::get<ChainGeometry>(right.geometry).after = DVec2{-4, 1};
    const auto whole = runnerOf(slide({build::chain({{4, 1}, {0, 0}, {-4, 1}})}));
    const auto pieces = runnerOf(slide({left, right}));
    int late = 0;  // a chain that a step gets to has contacts in the next one, though all of one chain has them at once
    for (int step = 0; step < 240; ++step) {
        ASSERT_TRUE(whole->step());
        ASSERT_TRUE(pieces->step());
        const Frame ofWhole = frameOf(*whole);
        const Frame ofPieces = frameOf(*pieces);
        ASSERT_EQ(ofPieces.bodies[1].position, ofWhole.bodies[1].position) << "step " << step;
        late += ofPieces.contacts.size() != ofWhole.contacts.size() ? 1 : 0;
    }
    EXPECT_LE(late, 2);
}

/// A hinge on it holds nothing, so that it has no error either.
TEST_P(PresentContacts, LeaveOutWhatTakesNoPart) {
    SceneDescription scene = boxOnFloor({0, 0.375}, {3, 0});
    build::addDynamic(scene, "ball", {0, 3}, {build::circle(0.5)});
    build::hinge(scene, "box", "ball", {0, 3});
    scene.bodies[1].enabled = false;
    scene.gravity = {0, -10};
    const auto runner = runnerOf(scene);
    for (int step = 0; step < 180; ++step) { ASSERT_TRUE(runner->step()); }
    const Frame frame = frameOf(*runner);
    EXPECT_EQ(frame.bodies[1].position, scene.bodies[1].position);
    EXPECT_FALSE(frame.bodies[1].awake);
    EXPECT_NEAR(frame.bodies[2].position.y, 0.5, 0.01) << "it falls past the box";
    const RunReport report = runner->report();
    EXPECT_LT(report.deepestPenetration, 0.02);
    EXPECT_EQ(report.largestJointError, 0);
    EXPECT_NEAR(report.startMomentum.x, 0, 1e-12);
    EXPECT_NEAR(report.startEnergy, 3 * 10 * kPi / 4, 1e-4) << "of the ball alone";
}

TEST_P(PresentContacts, OfAChainAreThoseThatTheStepHad) {
    SceneDescription scene = build::scene("platform", {0, 0}, 10);
    build::addFixed(scene, "platform", {0, 0}, {build::chain({{5, 0}, {0.25, 0}, {-5, 0}})});
    build::addDynamic(scene, "box", {0, -1}, {build::box({0.5, 0.5})}).velocity = {0, 6};
    const auto runner = runnerOf(scene);
    bool wasHalfThrough = false;
    double highest = -1;
    for (int step = 0; step < 240; ++step) {
        ASSERT_TRUE(runner->step());
        const Frame frame = frameOf(*runner);
        const double height = frame.bodies[1].position.y;
        highest = std::fmax(highest, height);
        if (step < 30 && height > 0 && height < 0.45) {
            wasHalfThrough = true;
            EXPECT_TRUE(frame.contacts.empty()) << "it comes through from the back";
        }
    }
    EXPECT_TRUE(wasHalfThrough);
    EXPECT_GT(highest, 0.6);
    const Frame frame = frameOf(*runner);
    EXPECT_NEAR(frame.bodies[1].position.y, 0.5, 0.01);
    EXPECT_GE(frame.contacts.size(), 2u) << "and stands on it";
    EXPECT_LT(runner->report().deepestPenetration, 0.01);
}

TEST_P(PresentContacts, TellWhichJointGapesMost) {
    SceneDescription scene = build::scene("pendulum", {0, 0}, 10);
    build::addFixed(scene, "wall", {0, 0}, {build::box({0.1, 0.1})});
    build::addDynamic(scene, "first", {1, 0}, {build::box({0.5, 0.1})});
    build::addDynamic(scene, "second", {2, 0}, {build::box({0.5, 0.1})}).velocity = {0, 90};
    build::hinge(scene, "wall", "first", {0.5, 0});
    build::hinge(scene, "first", "second", {1.5, 0});
    scene.settings.profile = SceneProfile::fast;
    const auto runner = runnerOf(scene);
    for (int step = 0; step < 60; ++step) { ASSERT_TRUE(runner->step()); }
    const RunReport report = runner->report();
    ASSERT_TRUE(report.worstJoint);
    EXPECT_GT(report.largestJointError, 0);
    EXPECT_GT(report.worstJoint->time, 0);
    EXPECT_LE(report.worstJoint->time, 1.001);
}

INSTANTIATE_TEST_SUITE_P(Precisions, PresentContacts, testing::Values(Precision::f32, Precision::f64),
                         precisionName<testing::TestParamInfo<Precision>>);

}  // namespace
}  // namespace swept::test
