#include <gtest/gtest.h>

#include <swept/samples/built_in/builtin_scenes.h>

#include "precision_name.h"
#include "trace_compare.h"

/// The same scene gives the same bits, run after run and whatever finds the pairs.

namespace swept::test {
namespace {

constexpr std::int64_t kStepsOfRun = 120;
constexpr std::int64_t kStepsPerBroadphase = 60;
constexpr SceneBroadphase kOthers[] = {SceneBroadphase::sortAndSweep, SceneBroadphase::quadtree, SceneBroadphase::grid,
                                       SceneBroadphase::bvh, SceneBroadphase::wideBvh};

class SceneRepeat : public testing::TestWithParam<Precision> {};

TEST_P(SceneRepeat, GivesTheSameBits) {
    for (const BuiltinScene& entry : builtinScenes()) {
        const SceneDescription scene = entry.make();
        const Trace first = runOf(scene, GetParam(), kStepsOfRun).trace;
        const Trace second = runOf(scene, GetParam(), kStepsOfRun).trace;
        EXPECT_TRUE(first.report.finite) << entry.name;
        EXPECT_EQ(firstDifference(first, second), "") << entry.name;
    }
}

TEST_P(SceneRepeat, DoesNotDependOnTheBroadphase) {
    for (const BuiltinScene& entry : builtinScenes()) {
        SceneDescription scene = entry.make();
        scene.settings.broadphase = SceneBroadphase::allPairs;
        const Trace pairs = runOf(scene, GetParam(), kStepsPerBroadphase).trace;
        for (const SceneBroadphase other : kOthers) {
            scene.settings.broadphase = other;
            const Trace trace = runOf(scene, GetParam(), kStepsPerBroadphase).trace;
            EXPECT_EQ(firstDifference(trace, pairs), "") << entry.name << " " << static_cast<int>(other);
        }
    }
}

TEST_P(SceneRepeat, ComparisonSeesTheSmallestChange) {
    SceneDescription scene = builtinScenes()[0].make();
    const Trace before = runOf(scene, GetParam(), 60).trace;
    scene.gravity.y = std::nextafter(scene.gravity.y, 0.0) + (GetParam() == Precision::f32 ? 1e-6 : 0);
    const Trace after = runOf(scene, GetParam(), 60).trace;
    EXPECT_NE(firstDifference(before, after), "");
}

INSTANTIATE_TEST_SUITE_P(Precisions, SceneRepeat, testing::Values(Precision::f32, Precision::f64),
                         precisionName<testing::TestParamInfo<Precision>>);

}  // namespace
}  // namespace swept::test
