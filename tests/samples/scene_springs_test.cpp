#include <gtest/gtest.h>

#include <memory>
#include <string>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>

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

/// What it has no spring for is refused, whatever its value, and so it is of joints whose springs have no target.
TEST(SpringTargets, NeedASpring) {
    struct Case {
        const char* members;
        const char* reason;  ///< must occur in it
    };
    for (const Case& c :
         {Case{R"("revolute", "anchor": [0, 1], "springTarget": 0.5)",
               "there is no spring to aim: \"hertz\" is missing"},
          Case{R"("revolute", "anchor": [0, 1], "springTarget": 0)", "no spring"},
          Case{R"("revolute", "anchor": [0, 1], "hertz": 1, "springTarget": "up")", "number"},
          Case{R"("prismatic", "anchor": [0, 1], "axis": [0, 1], "springTarget": 1)", "no spring"},
          Case{R"("wheel", "anchor": [0, 1], "axis": [0, 1], "springTarget": 1)", "no spring"},
          Case{R"("weld", "anchor": [0, 1], "springTarget": 1)", "unknown"},
          Case{R"("distance", "anchorA": [0, 5], "anchorB": [0, 1], "hertz": 1, "springTarget": 1)", "unknown"}}) {
        const SceneResult result = readScene(R"({"bodies": [{"name": "floor"}, {"name": "ball", "type": "dynamic",
            "shapes": [{"circle": {"radius": 1}}]}], "joints": [{"bodyA": "floor", "bodyB": "ball", "type": )" +
                                                 std::string(c.members) + "}]}",
                                             "my.json");
        EXPECT_FALSE(result.scene.has_value()) << c.members;
        EXPECT_EQ(result.error.pointer, "/joints/0/springTarget") << c.members << ": " << result.error.text();
        EXPECT_NE(result.error.reason.find(c.reason), std::string::npos) << c.members << ": " << result.error.text();
    }
}

}  // namespace
}  // namespace swept::test
