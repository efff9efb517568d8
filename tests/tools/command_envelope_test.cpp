#include <gtest/gtest.h>

#include "run_program.h"

namespace swept {
namespace {

std::vector<std::string> envelope(const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"envelope", "--coarse", "--slice", "bullet", "--threads", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

// One test, as the parts need the rows of the first.
TEST(CommandEnvelope, MapsGoesOnWhereItWasAndGathersShards) {
    const ScratchDirectory scratch;
    const ProgramResult result = runSwept(envelope({"--out", scratch.path("all")}));
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("m/s"), std::string::npos) << result.out;
    EXPECT_EQ(scratch.read("all/summary.txt"), result.out.substr(0, scratch.read("all/summary.txt").size()));
    EXPECT_EQ(result.err, "") << "no bar where there is no terminal";
    const std::string limits = scratch.read("all/limits.csv");
    EXPECT_NE(limits.find("bullet,f64,1000,#"), std::string::npos) << limits;

    const std::string rows = scratch.read("all/bullet.csv");
    scratch.write("all/bullet.csv", rows.substr(0, rows.size() / 2));
    ASSERT_EQ(runSwept(envelope({"--out", scratch.path("all")})).exitCode, 0);
    const std::string again = scratch.read("all/bullet.csv");
    EXPECT_EQ(again, rows) << "rows that are there are kept, and all are in the order of the map";
    EXPECT_EQ(scratch.read("all/limits.csv"), limits);

    for (const char* const shard : {"1/2", "2/2"}) {
        ASSERT_EQ(runSwept(envelope({"--out", scratch.path("parts"), "--shard", shard})).exitCode, 0);
        EXPECT_FALSE(scratch.has("parts/limits.csv"));
    }
    EXPECT_LT(scratch.read("parts/bullet.1-of-2.csv").size(), rows.size());
    ASSERT_EQ(runSwept(envelope({"--out", scratch.path("parts")})).exitCode, 0);
    EXPECT_EQ(scratch.read("parts/limits.csv"), limits);
}

TEST(CommandEnvelope, RefusesWhatItCannotDo) {
    const ScratchDirectory scratch;
    const std::string file = scratch.write("file", "not a directory");
    scratch.write("bullet.csv", "x,y\n1,2\n");
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"envelope", "--slice", "moon", "--out", scratch.path("no")}, "moon"},
        {envelope({"--out", scratch.path("no"), "--shard", "3/2"}), "--shard 3/2"},
        {envelope({"--out", scratch.path("no"), "--threads", "0"}), "--threads"},
        {envelope({"--out", file}), "cannot be written"},
        {envelope({"--out", scratch.path("")}), "bullet.csv"},
    };
    for (const auto& [arguments, reason] : cases) { expectRefused(arguments, reason); }
    EXPECT_FALSE(scratch.has("no"));
}

}  // namespace
}  // namespace swept
