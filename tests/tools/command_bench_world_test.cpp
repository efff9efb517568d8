#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "csv_records.h"
#include "run_program.h"
#include "scratch_directory.h"

namespace swept {
namespace {

TEST(CommandBenchWorld, EveryEnginePlaysCratesAtRest) {
    const ScratchDirectory scratch;
    const auto result = runSwept({"bench", "world", "--scenes", "crates", "--size", "0.02", "--steps", "5", "--repeats",
                                  "2", "--of", "fastest", "--csv", scratch.path("world.csv")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("of each step the fastest of 2"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("Milliseconds a step"), std::string::npos) << result.out;
    const auto records = recordsOf(scratch.read("world.csv"));
    EXPECT_GE(records.size(), 6U) << "four of ours and Box2D 2.4.1 at least";
    for (std::size_t i = 1; i < records.size(); ++i) {
        EXPECT_EQ(numberIn(records, i, "steps"), 5) << result.out;
        EXPECT_GT(numberIn(records, i, "secondsPerStep"), 0) << records[i][1];
        // Ten crates of a metre and a kilogram on each other, at rest: their energy is that of their heights.
        EXPECT_NEAR(numberIn(records, i, "startEnergy"), 10 * 10 * 5.0, 1) << records[i][1];
        EXPECT_NEAR(numberIn(records, i, "endEnergy"), 10 * 10 * 5.0, 20) << records[i][1];
    }
}

TEST(CommandBenchWorld, RagdollsThatAppearLieOnTheirTiles) {
    const ScratchDirectory scratch;
    const auto result =
        runSwept({"bench", "world", "--scenes", "rain", "--size", "0.025", "--steps", "3", "--repeats", "1",
                  "--engines", "fast f32,Box2D 2.4.1,Chipmunk 7", "--csv", scratch.path("world.csv")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const auto records = recordsOf(scratch.read("world.csv"));
    ASSERT_GE(records.size(), 3U);
    for (std::size_t i = 1; i < records.size(); ++i) {
        if (numberIn(records, i, "steps") == 0) {
            EXPECT_EQ(records[i][1], "Chipmunk 7") << "refuses ragdolls, the others do not: " << result.out;
            continue;
        }
        EXPECT_GT(numberIn(records, i, "deepest"), 0) << records[i][1] << " has nothing lie on anything";
        EXPECT_LT(numberIn(records, i, "deepest"), 0.05) << records[i][1];
        EXPECT_LT(numberIn(records, i, "jointGap"), 0.1) << records[i][1];
    }
}

TEST(CommandBenchWorld, WhatTakesTooLongIsStopped) {
    const auto result =
        runSwept({"bench", "world", "--scenes", "crates", "--seconds", "0", "--engines", "fast f32", "--repeats", "1"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("stopped"), std::string::npos) << result.out;
}

TEST(CommandBenchWorld, SaysWhichScenesItWrote) {
    const ScratchDirectory scratch;
    const auto result =
        runSwept({"bench", "world", "--write", scratch.path("scenes"), "--scenes", "rain,crates", "--size", "0.02"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out,
              "scene  " + scratch.path("scenes/rain.json") + "\nscene  " + scratch.path("scenes/crates.json") + '\n');
    EXPECT_TRUE(scratch.has("scenes/crates.json"));
}

TEST(CommandBenchWorld, RefusesWhatItCannotDo) {
    const std::vector<std::vector<std::string>> wrong = {
        {"bench", "world", "--scenes", "elsewhere"},
        {"bench", "world", "--engines", "steam"},
        {"bench", "world", "--size", "0"},
        {"bench", "world", "--of", "mean"},
        {"bench", "world", "--growth", "1000", "--size", "0.5"},
        {"bench", "world", "--csv", "no/such/directory/world.csv"},
    };
    for (const std::vector<std::string>& arguments : wrong) { expectRefused(arguments); }
}

}  // namespace
}  // namespace swept
