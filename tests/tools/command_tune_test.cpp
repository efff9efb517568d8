#include <gtest/gtest.h>

#include "run_program.h"
#include "small_scenes.h"
#include "tune_rows.h"

namespace swept {
namespace {

class CommandTune : public ::testing::Test {
protected:
    ProgramResult tune(const std::string& out, std::vector<std::string> more) {
        std::vector<std::string> arguments{"tune",      scene, "--steps", "16",
                                           "--threads", "2",   "--out",   scratch.path(out)};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return runSwept(arguments);
    }

    static std::vector<std::string> with(std::vector<std::string> some, const std::vector<std::string>& more) {
        some.insert(some.end(), more.begin(), more.end());
        return some;
    }

    const ScratchDirectory scratch;
    /// The ball of the small scenes, begun 1 cm inside the floor.
    const std::string scene = scratch.write(
        "ball.json", std::string(kBallScene).replace(std::string(kBallScene).find("[0, 5]"), 6, "[0, 0.49]"));
    const std::vector<std::string> limit{"--max-error", "penetration=0.02"};
};

// One test, as each part needs the rows of the first.
TEST_F(CommandTune, AdvisesGoesOnWhereItWasAndGathersShards) {
    const ProgramResult result = tune("out", limit);
    ASSERT_EQ(result.exitCode, 0) << result.err << result.out;
    // Which precision is cheaper for one ball is told by a clock, on a machine that does other things.
    EXPECT_NE(result.out.find("Recommended: f"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("Box2D 2.4.1"), std::string::npos) << result.out;
    EXPECT_EQ(result.err, "") << "no bar where there is no terminal";
    EXPECT_EQ(runSwept({"run", scratch.path("out/tuned.json"), "--steps", "2"}).exitCode, 0);
    const std::string rows = scratch.read("out/tune.csv");

    // Take some of them away, the last of those in the middle of its line.
    const std::size_t cut = rows.size() * 3 / 4;
    scratch.write("out/tune.csv", rows.substr(0, cut));
    ASSERT_EQ(tune("out", limit).exitCode, 0);
    const std::string again = scratch.read("out/tune.csv");
    const std::size_t kept = rows.rfind('\n', cut - 1) + 1;
    EXPECT_EQ(again.substr(0, kept), rows.substr(0, kept)) << "rows that are there are kept";
    EXPECT_EQ(rowsWithoutCost(again), rowsWithoutCost(rows));

    // What nothing can keep; the rows that are there serve any limit.
    ASSERT_TRUE(scratch.has("out/tuned.json"));
    const ProgramResult impossible = tune("out", {"--max-error", "penetration=0.001"});
    EXPECT_EQ(impossible.exitCode, 1) << impossible.out;
    EXPECT_NE(impossible.out.find("None of"), std::string::npos);
    EXPECT_FALSE(scratch.has("out/tuned.json")) << "what was recommended for another limit";
    EXPECT_NE(impossible.out.find("tuned.json of an earlier search is taken away"), std::string::npos)
        << impossible.out;

    for (const char* const shard : {"1/2", "2/2"}) {
        ASSERT_EQ(tune("parts", with(limit, {"--shard", shard})).exitCode, 0);
    }
    ASSERT_EQ(tune("parts", with(limit, {"--gather"})).exitCode, 0);
    EXPECT_EQ(rowsWithoutCost(scratch.read("parts/tune.csv")), rowsWithoutCost(rows));
}

TEST_F(CommandTune, TellsWhatTheSceneCanDoWithout) {
    const ProgramResult result = tune("out", with(limit, {"--ablate"}));
    ASSERT_EQ(result.exitCode, 0) << result.err << result.out;
    EXPECT_NE(result.out.find("Leanest profile: without"), std::string::npos) << result.out;
    EXPECT_NE(scratch.read("out/ablation.csv").find("\nfriction,"), std::string::npos);
    EXPECT_FALSE(scratch.has("out/tune.csv"));
    EXPECT_EQ(runSwept({"run", scratch.path("out/lean.json"), "--steps", "2"}).exitCode, 0);
}

TEST_F(CommandTune, DecidesNothingWhereTheSceneMissesTheErrors) {
    ASSERT_EQ(tune("out", with(limit, {"--ablate"})).exitCode, 0);
    const ProgramResult result = tune("out", {"--max-error", "penetration=0.001", "--ablate"});
    EXPECT_EQ(result.exitCode, 1) << result.err;
    EXPECT_NE(result.out.find("is not decided: as it is, the scene does not keep these errors (penetration 0.01"),
              std::string::npos)
        << result.out;
    EXPECT_EQ(result.out.find("needed"), std::string::npos) << result.out;
    EXPECT_FALSE(scratch.has("out/lean.json")) << "what was found for another limit";
}

TEST_F(CommandTune, RefusesBadInputAndWritesNothing) {
    const std::vector<std::vector<std::string>> cases{
        {},
        {"--max-error", "penetratoin=1"},
        {"--max-error", "penetration=-1"},
        {"--max-error", "joint-error=0.1"},  // there is no joint
        {"--max-error", "penetration=1", "--shard", "3/2"},
        {"--max-error", "penetration=1", "--shard", "1/2", "--gather"},
        {"--max-error", "penetration=1", "--gather"},  // nothing to gather
        {"--max-error", "penetration=1", "--ablate", "--shard", "1/2"},
        {"--max-error", "penetration=1", "--threads", "0"},
        {"--max-error", "penetration=1", "--precision", "f64"},
        {"--max-error", "penetration=1", "--set", "/settings/dt=-1"}};
    for (const std::vector<std::string>& arguments : cases) {
        const ProgramResult result = tune("out", arguments);
        EXPECT_EQ(result.exitCode, 2) << (arguments.empty() ? "" : arguments[1]) << result.err;
        EXPECT_FALSE(result.err.empty());
        EXPECT_FALSE(scratch.has("out")) << result.err;
    }
}

TEST_F(CommandTune, DoesNotWriteOverItsScene) {
    const std::string tuned = scratch.write("tuned.json", scratch.read("ball.json"));
    const ProgramResult result = runSwept(with({"tune", tuned, "--steps", "16", "--out", scratch.path(".")}, limit));
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("would overwrite the input"), std::string::npos) << result.err;
    EXPECT_EQ(scratch.read("tuned.json"), scratch.read("ball.json"));
    EXPECT_FALSE(scratch.has("tune.csv"));
}

TEST_F(CommandTune, RefusesRowsOfAnotherScene) {
    const std::vector<std::string> part = with(limit, {"--shard", "12/12"});  // little work
    ASSERT_EQ(tune("out", part).exitCode, 0);
    const std::string before = scratch.read("out/tune.12-of-12.csv");
    const ProgramResult result = tune("out", with(part, {"--set", "/bodies/1/position=[0,6]"}));
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.err.find("another scene"), std::string::npos) << result.err;
    EXPECT_EQ(scratch.read("out/tune.12-of-12.csv"), before);
    scratch.write("out/tune.12-of-12.csv", "what, is, this\n");
    EXPECT_EQ(tune("out", part).exitCode, 2);
    EXPECT_EQ(scratch.read("out/tune.12-of-12.csv"), "what, is, this\n");
}

}  // namespace
}  // namespace swept
