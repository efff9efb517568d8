#include <gtest/gtest.h>

#include <string>

#include "run_program.h"

namespace swept {
namespace {

constexpr const char* kModes[] = {"off", "speedLimit", "speculative", "stop", "subStep"};

TEST(CommandModes, HasALineForEveryModeAndOnePicture) {
    const ScratchDirectory scratch;
    const std::string png = scratch.path("modes.png");
    const ProgramResult result =
        runSwept({"modes", "continuous-off", "--steps", "1", "--size", "120x120", "--png", png});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    for (const char* const mode : kModes) {
        EXPECT_NE(result.out.find(std::string("\n") + mode + ' '), std::string::npos) << mode << " in:\n" << result.out;
    }
    EXPECT_NE(result.out.find("lost: of their steps, by all bodies together"), std::string::npos) << result.out;
    EXPECT_EQ(scratch.read("modes.png").substr(1, 3), "PNG");
}

/// What flies on through empty space gains nothing, however little energy it has to compare with.
TEST(CommandModes, TellsTheChangeOfEnergy) {
    const std::string scene = R"({"gravity": [0, 0], "bodies": [
      {"type": "dynamic", "velocity": [0, -1], "shapes": [{"circle": {"radius": 0.5}}]}]})";
    for (const char* const velocity : {"[0,0]", "[1,2]"}) {
        const ProgramResult result =
            runSwept({"modes", "-", "--steps", "1", "--set", "/bodies/0/velocity=" + std::string(velocity)}, scene);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_NE(result.out.find("energy change (J)"), std::string::npos) << result.out;
        EXPECT_NE(result.out.find("off                0        0        0          0                  0 "),
                  std::string::npos)
            << result.out;
    }
}

TEST(CommandModes, RefusesWhatItCannotDo) {
    EXPECT_EQ(runSwept({"modes", "no-such-scene"}).exitCode, 2);
    EXPECT_EQ(runSwept({"modes", "continuous-off", "--steps", "1", "--size", "big", "--png", "x.png"}).exitCode, 2);
}

/// What the page claims of the modes, with few shots: sweeps let nothing through and make nothing up.
TEST(CommandModes, BenchMeasuresWhatThePageSays) {
    const ScratchDirectory scratch;
    const std::string csv = scratch.path("modes.csv");
    const ProgramResult result = runSwept({"bench", "continuous", "--count", "3", "--csv", csv});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const std::string text = scratch.read("modes.csv");
    EXPECT_NE(text.find("modes,subStep,missed,0\r\n"), std::string::npos) << text;
    EXPECT_NE(text.find("modes,subStep,ghosts,0\r\n"), std::string::npos) << text;
    EXPECT_NE(text.find("modes,stop,missed,0\r\n"), std::string::npos) << text;
    EXPECT_NE(text.find("modes,speedLimit,missed,0\r\n"), std::string::npos) << text;
    EXPECT_NE(text.find("modes,speculative,ballsMissed,0\r\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("modes,off,missed,0\r\n"), std::string::npos) << text;
    EXPECT_EQ(runSwept({"bench", "continuous", "--count", "0"}).exitCode, 2);
}

}  // namespace
}  // namespace swept
