#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "run_program.h"
#include "scratch_directory.h"

namespace swept {
namespace {

TEST(CommandBenchBroadphase, MeasuresOneSceneAndWritesIt) {
    const ScratchDirectory scratch;
    const auto result = runSwept({"bench", "broadphase", "--count", "60", "--scenes", "uniform", "--seconds", "0",
                                  "--csv", scratch.path("bench.csv")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("uniform: ns per renewed box"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("other pairs!"), std::string::npos) << result.out;
    const std::string csv = scratch.read("bench.csv");
    EXPECT_NE(csv.find("\nuniform,allPairs,60,"), std::string::npos) << csv;
    EXPECT_NE(csv.find("\nuniform,Box2D 2.4.1,60,"), std::string::npos) << csv;
}

TEST(CommandBenchBroadphase, OverlapWritesItsTable) {
    const ScratchDirectory scratch;
    const auto result = runSwept({"bench", "overlap", "--count", "20", "--csv", scratch.path("overlap.csv")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(result.out.find("misses"), std::string::npos) << result.out;
    EXPECT_NE(scratch.read("overlap.csv").find("\nbars,OBB,1,20,"), std::string::npos);
}

TEST(CommandBenchBroadphase, RefusesWhatItCannotDo) {
    const std::vector<std::vector<std::string>> wrong = {
        {"bench", "broadphase", "--kinds", "guessing"},
        {"bench", "broadphase", "--scenes", "elsewhere"},
        {"bench", "broadphase", "--max-count", "10000000"},
        {"bench", "broadphase", "--count", "100", "--max-count", "100"},
        {"bench", "broadphase", "--csv", "no/such/directory/bench.csv"},
        {"bench", "overlap", "--count", "0"},
        {"bench", "overlap", "--csv", "no/such/directory/bench.csv"},
    };
    for (const std::vector<std::string>& arguments : wrong) { expectRefused(arguments); }
}

}  // namespace
}  // namespace swept
