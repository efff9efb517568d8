#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <swept/tools/worlds/joint_scenes.h>

#include "csv_records.h"
#include "run_program.h"
#include "scratch_directory.h"

namespace swept {
namespace {

TEST(CommandBenchJoints, EverySortOfJointHoldsInOursAndBox2d) {
    const ScratchDirectory scratch;
    const auto result =
        runSwept({"bench", "joints", "--engines", "fast f32,accurate f32,accurate f64,Box2D 2.4.1", "--size", "0.02",
                  "--steps", "5", "--repeats", "1", "--csv", scratch.path("joints.csv")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("Microseconds a step for each joint"), std::string::npos) << result.out;
    const auto records = recordsOf(scratch.read("joints.csv"));
    ASSERT_EQ(records.size(), 1 + 4 * worlds::jointScenes().size()) << result.out;
    for (std::size_t i = 1; i < records.size(); ++i) {
        const std::string what = records[i][0] + ", " + records[i][1];
        EXPECT_EQ(numberIn(records, i, "steps"), 5) << what;
        EXPECT_GT(numberIn(records, i, "secondsPerStep"), 0) << what;
        const bool isAccurate = records[i][1].starts_with("accurate");
        EXPECT_LT(numberIn(records, i, "jointGap"), isAccurate ? 1e-3 : 0.03) << what;
        EXPECT_EQ(numberIn(records, i, "deepest"), 0) << what << ": nothing is to be solved but joints";
    }
}

/// Which Box2D 3 plays, where it is there, but for two.
TEST(CommandBenchJoints, ComparesBothBox2dUnlessOthersAreAskedFor) {
    const auto result = runSwept({"bench", "joints", "--size", "0.02", "--steps", "5", "--repeats", "1"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const char* const engine : {"fast f32", "accurate f32", "Box2D 2.4.1"}) {
        EXPECT_NE(result.out.find(engine), std::string::npos) << engine;
    }
    EXPECT_EQ(result.out.find("f64"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("aborted"), std::string::npos) << result.out;
    if (result.out.find("Box2D 3") == std::string::npos) { return; }
    const auto told = result.out.find("pulleys, Box2D 3:");
    ASSERT_NE(told, std::string::npos) << result.out;
    EXPECT_EQ(result.out.substr(told),
              "pulleys, Box2D 3: Box2D 3 has no pulley joints\ngears, Box2D 3: Box2D 3 has no gear joints\n");
}

TEST(CommandBenchJoints, MeasuresTheSortsThatAreAskedFor) {
    const auto result = runSwept({"bench", "joints", "--joints", "rods,wheels", "--engines", "fast f32", "--size",
                                  "0.01", "--steps", "1", "--repeats", "1"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const char* const scene : {"rods ", "wheels "}) {
        EXPECT_NE(result.out.find(scene), std::string::npos) << result.out;
    }
    EXPECT_EQ(result.out.find("hinges"), std::string::npos) << result.out;
}

TEST(CommandBenchJoints, RefusesWhatItCannotDo) {
    const std::vector<std::vector<std::string>> wrong = {
        {"bench", "joints", "--joints", "elsewhere"}, {"bench", "joints", "--joints", "crates"},
        {"bench", "joints", "--engines", "steam"},    {"bench", "joints", "--size", "0"},
        {"bench", "joints", "--steps", "0"},          {"bench", "joints", "--csv", "no/such/directory/joints.csv"},
    };
    for (const std::vector<std::string>& arguments : wrong) { expectRefused(arguments); }
}

}  // namespace
}  // namespace swept
