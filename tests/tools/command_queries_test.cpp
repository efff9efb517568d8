#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run_program.h"
#include "scratch_directory.h"

namespace swept {
namespace {

const char* const kBallFallsOnEdge =
    R"({"id": "one", "a": {"vertices": [[-1, 0], [1, 0]], "radius": 0, "sweep": {"localCenter": [0, 0], "c0": [0, 0], "c1": [0, 0], "a0": 0, "a1": 0}}, "b": {"vertices": [[0, 0]], "radius": 0.5, "sweep": {"localCenter": [0, 0], "c0": [0, 3], "c1": [0, -3], "a0": 0, "a1": 2.5}}, "tMax": 1, "target": 0.01, "tolerance": 0.001})";

TEST(CommandQueries, AnswersFromStandardInput) {
    const auto result = runSwept({"toi"}, std::string(kBallFallsOnEdge) + "\n\n");
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto answer = nlohmann::json::parse(result.out);
    EXPECT_EQ(answer.at("id"), "one");
    EXPECT_EQ(answer.at("state"), "hit");
    EXPECT_NEAR(answer.at("t"), (3 - 0.51) / 6, 0.001);
}

TEST(CommandQueries, AnswersAFile) {
    const ScratchDirectory scratch;
    const std::string file = scratch.write("queries.jsonl", kBallFallsOnEdge);
    for (const char* const precision : {"f32", "f64"}) {
        const auto result = runSwept({"distance", file, "--precision", precision});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_NEAR(nlohmann::json::parse(result.out).at("distance"), 2.5, 1e-6);
    }
    const auto cast = runSwept({"toi", file, "--method", "shapeCast"});
    ASSERT_EQ(cast.exitCode, 0) << cast.err;
    EXPECT_EQ(nlohmann::json::parse(cast.out).at("state"), "hit");
}

TEST(CommandQueries, ABadLineIsAnsweredInItsPlace) {
    const auto result = runSwept({"toi"}, std::string(kBallFallsOnEdge) + "\nnonsense\n" + kBallFallsOnEdge + "\n");
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_NE(result.out.find("\"error\""), std::string::npos);
    EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3);
}

TEST(CommandQueries, DrawsTheAnatomyOfAQuery) {
    const ScratchDirectory scratch;
    const std::string picture = scratch.path("anatomy.png");
    EXPECT_EQ(runSwept({"toi", "--anatomy", picture}, "\n").exitCode, 2);
    EXPECT_EQ(runSwept({"toi", "--anatomy", picture}, "nonsense\n").exitCode, 2);
    EXPECT_EQ(runSwept({"toi", "--anatomy", scratch.path("none/x.png")}, kBallFallsOnEdge).exitCode, 2);
    EXPECT_FALSE(std::filesystem::exists(picture)) << "a refused command leaves nothing";
    const auto drawn = runSwept({"toi", "--anatomy", picture}, kBallFallsOnEdge);
    if (drawn.err.find("not installed") != std::string::npos) { GTEST_SKIP() << drawn.err; }
    ASSERT_EQ(drawn.exitCode, 0) << drawn.err;
    EXPECT_GT(std::filesystem::file_size(picture), 10'000U);
    EXPECT_EQ(nlohmann::json::parse(drawn.out).at("state"), "hit");
}

TEST(CommandQueries, DrawsBodiesThatTouchFromTheStart) {
    const ScratchDirectory scratch;
    const std::string picture = scratch.path("anatomy.png");
    for (const char* const family : {"overlap", "touch"}) {
        const std::string query = runSwept({"toi", "--generate", family, "--seed", "1", "--count", "1"}).out;
        const auto drawn = runSwept({"toi", "--anatomy", picture}, query);
        if (drawn.err.find("not installed") != std::string::npos) { GTEST_SKIP() << drawn.err; }
        EXPECT_EQ(drawn.exitCode, 0) << family << ": " << drawn.err;
        EXPECT_EQ(drawn.out, runSwept({"toi"}, query).out);
    }
}

TEST(CommandQueries, TheAnatomyTellsWhichLineOfWhatIsBad) {
    const ScratchDirectory scratch;
    const std::string picture = scratch.path("anatomy.png");
    const std::string file = scratch.write("queries.jsonl", "\n \n{\"id\": 1,}\n");
    expectRefused({"toi", file, "--anatomy", picture}, file + ": line 3, column 9: ");
    expectRefused({"toi", "--anatomy", picture}, "standard input: line 2: /a: is missing", "\n{\"id\": 1}\n");
    expectRefused({"toi", "--anatomy", picture}, "standard input: there is no query", "\n");
}

TEST(CommandQueries, APictureThatDoesNotArriveIsNoSuccess) {
    if (!std::filesystem::exists("/dev/full")) { GTEST_SKIP() << "this system has no /dev/full"; }
    const ScratchDirectory scratch;
    const auto full = runSwept({"toi", "--anatomy", "/dev/full"}, kBallFallsOnEdge);
    if (full.err.find("not installed") != std::string::npos) { GTEST_SKIP() << full.err; }
    EXPECT_EQ(full.exitCode, 2);
    EXPECT_EQ(full.err, "swept: --anatomy /dev/full: could not be written to the end\n");
    EXPECT_EQ(full.out, runSwept({"toi"}, kBallFallsOnEdge).out) << "the answer needs no picture";
    expectRefused({"toi", "--anatomy", scratch.path("a.jpg")}, "--anatomy " + scratch.path("a.jpg") + ": writes PNG",
                  kBallFallsOnEdge);
    EXPECT_TRUE(scratch.isEmpty());
}

TEST(CommandQueries, GeneratesQueriesThatItCanAnswer) {
    const std::vector<std::string> generate = {"toi", "--generate", "ca_worst", "--count", "20", "--seed", "7"};
    const auto queries = runSwept(generate);
    ASSERT_EQ(queries.exitCode, 0) << queries.err;
    EXPECT_EQ(std::count(queries.out.begin(), queries.out.end(), '\n'), 20);
    const auto first = nlohmann::json::parse(queries.out.substr(0, queries.out.find('\n')));
    EXPECT_EQ(first.at("id"), "ca_worst-7-0");
    EXPECT_EQ(first.at("family"), "ca_worst");
    EXPECT_EQ(runSwept(generate).out, queries.out) << "the same seed, the same queries";
    EXPECT_NE(runSwept({"toi", "--generate", "ca_worst", "--count", "20"}).out, queries.out);

    const auto answers = runSwept({"toi"}, queries.out);
    ASSERT_EQ(answers.exitCode, 0) << answers.err;
    const auto answer = nlohmann::json::parse(answers.out.substr(0, answers.out.find('\n')));
    EXPECT_EQ(answer.at("id"), "ca_worst-7-0");
    EXPECT_EQ(answer.at("tolerance"), first.at("tolerance")) << "every digit survives";
}

TEST(CommandQueries, GeneratesOnlyWhatItKnows) {
    const auto unknown = runSwept({"toi", "--generate", "nonsense"});
    EXPECT_EQ(unknown.exitCode, 2);
    EXPECT_NE(unknown.err.find("ca_worst"), std::string::npos) << "the families are named";
    EXPECT_EQ(runSwept({"toi", "--generate", "generic", "--method", "certified"}).exitCode, 2);
    EXPECT_EQ(runSwept({"toi", "--generate", "generic", "--count", "-1"}).exitCode, 2);
    EXPECT_EQ(runSwept({"toi", "--count", "5"}).exitCode, 2);
}

}  // namespace
}  // namespace swept
