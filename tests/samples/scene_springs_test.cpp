#include <gtest/gtest.h>

#include <memory>
#include <string>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>

/// Springs of hinges, sliders and wheels rest where their scene has them pull to.

namespace swept::test {
namespace {

class SceneSprings : public testing::TestWithParam<Precision> {
protected:
    /// The second body of a scene after four seconds.
    BodyFrame rested(const SceneDescription& scene) const {
        RunnerOptions options;
        options.precision = GetParam();
        std::string error;
        const std::unique_ptr<Runner> runner = makeRunner(scene, options, error);
        EXPECT_NE(runner, nullptr) << error;
        if (runner == nullptr) { return {}; }
        constexpr int kSteps = 240;
        return runTrace(*runner, kSteps, kSteps).frames.back().bodies[1];
    }

    static SceneDescription tied() {
        SceneDescription scene = build::scene("spring", {0, 0}, 4);
        scene.gravity = {};
        build::addFixed(scene, "base", {0, 0}, {build::box({0.2, 0.2})});
        build::addDynamic(scene, "held", {1, 0}, {build::box({0.3, 0.2})});
        return scene;
    }

    template <class Members>
    static void aim(Members& joint, double target) {
        joint.hertz = 2;
        joint.dampingRatio = 1;
        joint.springTarget = target;
    }
};

constexpr double kNear = 1e-3;

TEST_P(SceneSprings, OfHingesTurnToTheirTarget) {
    SceneDescription scene = tied();
    aim(build::hinge(scene, "base", "held", {0.5, 0}), 0.75);
    EXPECT_NEAR(rested(scene).angle, 0.75, kNear);
}

TEST_P(SceneSprings, OfSlidersSlideToTheirTarget) {
    SceneDescription scene = tied();
    aim(build::slider(scene, "base", "held", {1, 0}, {0, 2}), -0.5);
    EXPECT_NEAR(rested(scene).position.y, -0.5, kNear);
}

TEST_P(SceneSprings, OfWheelsSlideToTheirTarget) {
    SceneDescription scene = tied();
    aim(build::wheel(scene, "base", "held", {1, 0}, {0, 2}), 0.25);
    EXPECT_NEAR(rested(scene).position.y, 0.25, kNear);
}

INSTANTIATE_TEST_SUITE_P(Precisions, SceneSprings, testing::Values(Precision::f32, Precision::f64),
                         [](const auto& given) { return std::string(given.param == Precision::f32 ? "f32" : "f64"); });

}  // namespace
}  // namespace swept::test
