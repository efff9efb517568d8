#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_units.h>

#include "../support/thread_tasks.h"
#include "settling_scene.h"
#include "trace_compare.h"

/// Power-of-two invariance: a scene told in other units of length, mass and time gives the same run, bit for bit, up to
/// the factors. That is the proof that no length, mass or time is built into the library. On one thread and on two,
/// which must agree in every bit whatever underflows. Some units in every run, all of them in the long one
/// (SWEPT_ALL_UNITS).

namespace swept::test {
namespace {

constexpr std::int64_t kScaledSteps = 120;
constexpr std::int64_t kSettlingSteps = 400;  ///< bodies fall asleep, and the piston wakes one of them

#ifdef SWEPT_ALL_UNITS
constexpr auto kFloatUnits = std::to_array<Units>(
    {{10, 0, 0}, {-10, 0, 0}, {0, 10, 0}, {0, -10, 0}, {0, 0, 10}, {0, 0, -10}, {1, 0, 0}, {7, -5, 3}, {-10, -10, 10}});
constexpr auto kDoubleUnits = std::to_array<Units>({{100, 0, 0},
                                                    {-100, 0, 0},
                                                    {0, 100, 0},
                                                    {0, -100, 0},
                                                    {0, 0, 100},
                                                    {0, 0, -100},
                                                    {0, 0, 1},
                                                    {57, -33, 15},
                                                    {-100, 100, -100}});
#else
constexpr auto kFloatUnits = std::to_array<Units>({{10, 0, 0}, {7, -5, 3}, {-10, -10, 10}});
constexpr auto kDoubleUnits = std::to_array<Units>({{0, 0, 100}, {57, -33, 15}, {-100, 100, -100}});
#endif

struct Tally {
    int conclusive = 0;
    int underflown = 0;
};

/// Runs that differ because they lost digits to underflow prove nothing, and are counted. Most lose none that matter:
/// of what rests the square of a velocity of 1e-20 m/s underflows, beside others that do not.
void compareScaled(const SceneDescription& scene, const SceneRun& plain, Precision precision, const Units& units,
                   bool onTwoThreads, Tally& tally) {
    const std::int64_t steps = plain.trace.frames.back().step;
    const SceneDescription inUnits = scaled(scene, units.length, units.mass, units.time);
    const SceneRun other = runOf(inUnits, precision, steps);
    if (onTwoThreads) {
        ThreadTasks tasks(2);
        const SceneRun shared = runOf(inUnits, precision, steps, &tasks);
        EXPECT_EQ(firstDifference(other.trace, shared.trace), "") << scene.name << ", two threads, " << text(units);
    }
    const std::string difference = firstDifference(plain.trace, other.trace, units);
    if (!difference.empty() && (plain.underflow || other.underflow)) {
        ++tally.underflown;
        return;
    }
    ++tally.conclusive;
    EXPECT_EQ(difference, "") << scene.name << ", " << text(units);
}

/// In the short run the last units are tried on two threads.
void compareAll(const SceneDescription& scene, const SceneRun& plain, Precision precision, std::span<const Units> all,
                Tally& tally) {
#ifdef SWEPT_ALL_UNITS
    constexpr bool everyTime = true;
#else
    constexpr bool everyTime = false;
#endif
    for (const Units& units : all) {
        compareScaled(scene, plain, precision, units, everyTime || &units == &all.back(), tally);
    }
}

void compareAll(Precision precision, std::span<const Units> all) {
    Tally tally;
    for (const BuiltinScene& entry : builtinScenes()) {
        const SceneDescription scene = entry.make();
        const SceneRun plain = runOf(scene, precision, kScaledSteps);
        compareAll(scene, plain, precision, all, tally);
    }
    const SceneDescription settling = settlingScene();
    const SceneRun plain = runOf(settling, precision, kSettlingSteps);
    compareAll(settling, plain, precision, all, tally);
    testing::Test::RecordProperty("conclusive", tally.conclusive);
    testing::Test::RecordProperty("underflown", tally.underflown);
    // In float, impulses of unloaded joints decay below the normal numbers in one scene, and in another one speeds that
    // friction leaves to tiny things at rest: 1e-26 m/s, times arms and masses that are tiny, too. (19 was asked when
    // these were lost in sums with the speeds of whole points.)
    constexpr int kFewest = 15;
    EXPECT_GT(tally.conclusive, kFewest * tally.underflown) << "too many runs underflowed to prove anything";
}

TEST(SceneScaling, SinglePrecisionHasNoUnits) { compareAll(Precision::f32, kFloatUnits); }

TEST(SceneScaling, DoublePrecisionHasNoUnits) { compareAll(Precision::f64, kDoubleUnits); }

/// What the settling scene is for really happens in it.
TEST(SceneScaling, SettlingSceneDoesIt) {
    const Trace trace = runOf(settlingScene(), Precision::f64, kSettlingSteps).trace;
    const auto counted = [&trace](std::string_view name) {
        for (const NamedNumber& counter : trace.report.counters) {
            if (counter.name == name) { return counter.value; }
        }
        return 0.0;
    };
    for (const char* name : {"fellAsleep", "wokeUp", "speedsLimited", "impacts", "solvedBodies", "freeBodies"}) {
        EXPECT_GT(counted(name), 0) << name;
    }
    for (const SceneEventType type :
         {SceneEventType::begin, SceneEventType::hit, SceneEventType::sensorBegin, SceneEventType::jointBreak}) {
        const auto count = std::count_if(trace.events.begin(), trace.events.end(),
                                         [type](const SceneEvent& event) { return event.type == type; });
        EXPECT_GT(count, 0) << "type " << static_cast<int>(type);
    }
    EXPECT_FALSE(trace.report.lostTime.empty());
}

TEST(SceneScaling, ComparisonSeesAFactorThatIsForgotten) {
    const SceneDescription scene = builtinScenes()[0].make();
    const SceneRun plain = runOf(scene, Precision::f64, 30);
    SceneDescription forgetful = scaled(scene, 3, 0, 0);
    forgetful.gravity = scene.gravity;
    EXPECT_NE(firstDifference(plain.trace, runOf(forgetful, Precision::f64, 30).trace, {3, 0, 0}), "");
}

}  // namespace
}  // namespace swept::test
