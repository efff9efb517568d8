#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "refused_runs.h"
#include "run_program.h"

/// Input at the ends of what can be written, and runs that leave less than was asked for.

namespace swept {
namespace {

class CommandLimits : public RefusedRuns {
protected:
    void expectRunRefused(const std::vector<std::string>& more, const std::string& reason) {
        std::vector<std::string> arguments{"run", scene_, "--csv", out_.path("states.csv")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expectNothingWritten(arguments, reason);
    }
};

TEST_F(CommandLimits, StepsThatTheEngineRefuses) {
    for (const char* const dt : {"/settings/dt=1e19", "/settings/dt=1e-19"}) {
        expectRunRefused({"--steps", "3", "--set", dt}, ": /settings/dt: is out of range: f32 takes numbers up to 9");
        EXPECT_EQ(runSwept({"run", scene_, "--steps", "1", "--precision", "f64", "--set", dt}).exitCode, 0) << dt;
    }
}

TEST_F(CommandLimits, NumbersOfScenesThatSinglePrecisionRefuses) {
    for (const std::string pointer : {"/gravity", "/bodies/1/velocity", "/bodies/1/position"}) {
        expectRunRefused({"--steps", "1", "--set", pointer + "=[0, 1e19]"}, ": " + pointer + ": is out of range");
    }
    for (const std::string pointer :
         {"/bodies/1/angle", "/bodies/1/angularVelocity", "/bodies/1/gravityScale", "/bodies/1/shapes/0/density"}) {
        expectRunRefused({"--steps", "1", "--set", pointer + "=1e19"}, ": " + pointer + ": is out of range");
        EXPECT_EQ(runSwept({"run", scene_, "--steps", "1", "--precision", "f64", "--set", pointer + "=1e19"}).exitCode,
                  0)
            << pointer;
    }
}

TEST_F(CommandLimits, PointsThatSinglePrecisionCannotTellApart) {
    const std::string far =
        in_.write("far.json", R"({"bodies": [{"shapes": [{"polygon": [[1e9, 0], [1000000001, 0], [1e9, 1]]}]}]})");
    const std::vector<std::string> run{"run", far, "--steps", "1", "--csv", out_.path("states.csv")};
    expectNothingWritten(run,
                         ": /bodies/0/shapes/0: points is degenerate (no extent): f32 cannot tell its points apart "
                         "so far from the body's origin; --precision f64 can");
    std::vector<std::string> inDouble = run;
    inDouble.insert(inDouble.end(), {"--precision", "f64"});
    EXPECT_EQ(runSwept(inDouble).exitCode, 0);
}

TEST_F(CommandLimits, OutputsThatCannotBeWrittenLeaveNothingHalfDone) {
    if (!std::filesystem::exists("/dev/full")) { GTEST_SKIP() << "this system has no /dev/full"; }
    expectRunRefused(
        {"--steps", "128", "--events", "/dev/full", "--report", out_.write("old.json", "of an earlier run")},
        "--events /dev/full: could not be written to the end");
}

TEST_F(CommandLimits, TellsOfStatesThatOverflowed) {
    const auto overflown = runSwept({"run", "newtons-cradle", "--set", "/settings/dt=1e15", "--steps", "3"});
    EXPECT_EQ(overflown.exitCode, 0) << overflown.err;
    EXPECT_NE(overflown.err.find("overflowed and were put back"), std::string::npos) << overflown.err;
    EXPECT_EQ(runSwept({"run", scene_, "--steps", "64"}).err, "");
}

TEST_F(CommandLimits, TellsOfBudgetsInTheirUnits) {
    const auto over = runSwept({"run", scene_, "--set", "/settings/maxPenetration=0", "/settings/continuous=\"off\""});
    EXPECT_EQ(over.exitCode, 0);
    EXPECT_NE(over.err.find(" m is above the scene's budget maxPenetration = 0 m\n"), std::string::npos) << over.err;
}

TEST_F(CommandLimits, TellsOfDurationsWithoutAStep) {
    const auto none = runSwept({"run", scene_, "--duration", "10", "--set", "/settings/dt=100"});
    EXPECT_EQ(none.exitCode, 0);
    EXPECT_NE(none.err.find("warning: 10 s is less than half a step of 100 s"), std::string::npos) << none.err;
    EXPECT_EQ(runSwept({"run", scene_, "--duration", "0"}).err, "");
    EXPECT_EQ(runSwept({"run", scene_, "--steps", "0"}).err, "");
}

TEST_F(CommandLimits, WholeNumbers) {
    expectRunRefused({"--steps", "99999999999999999999"}, "--steps: 99999999999999999999 is too large");
    expectRunRefused({"--steps", "1e3"}, "--steps: must be a whole number, written in digits, not 1e3");
    expectRunRefused({"--steps", "0x10"}, "--steps: must be a whole number");
    expectRefused({"bench", "overlap", "--seed", "99999999999999999999999"}, "--seed: 99999999999999999999999 is too");
    expectRunRefused({"--steps", "010"}, "--steps: must be a whole number");  // not 8
}

TEST_F(CommandLimits, NamesOfFiles) {
    expectRunRefused({"--events", ""}, "--events: must not be empty");
    expectRunRefused({"--webp", out_.path("a.gif")}, "a.gif: writes WebP");
    expectRefused({"run", in_.path("")}, "is a folder, not a scene file");
}

TEST_F(CommandLimits, PicturesThatNobodyAskedFor) {
    expectRunRefused({"--every", "3"}, "swept: --every needs --png or --webp\n");
    expectRunRefused({"--size", "100x100"}, "swept: --size needs --png or --webp\n");
    expectRunRefused({"--view", "0,0,5"}, "swept: --view needs --png or --webp\n");
    expectRunRefused({"--follow", "ball"}, "swept: --follow needs --png or --webp\n");
    expectRunRefused({"--size", "1x"}, "swept: --size 1x: expected WIDTHxHEIGHT in pixels");
}

TEST_F(CommandLimits, CommandsBelowOthers) {
    expectRefused({"bench", "foo"}, "bench foo: no such command (\"swept bench --help\" lists them)");
    expectRefused({"bench"}, "swept: no command given (\"swept bench --help\" lists them)");
}

TEST_F(CommandLimits, HelpIsACommandToo) {
    for (const std::vector<std::string>& words : {std::vector<std::string>{}, {"run"}, {"bench"}, {"bench", "world"}}) {
        std::vector<std::string> asWord{"help"};
        asWord.insert(asWord.end(), words.begin(), words.end());
        std::vector<std::string> asOption = words;
        asOption.emplace_back("--help");
        const auto help = runSwept(asWord);
        EXPECT_EQ(help.exitCode, 0) << help.err;
        EXPECT_EQ(help.out, runSwept(asOption).out);
        EXPECT_NE(help.out, "");
    }
    expectRefused({"help", "rnu"}, "rnu: no such command; did you mean run?");
}

TEST_F(CommandLimits, NumbersThatAreNoneOrTooSmall) {
    expectRefused({"run", scene_, "--set", "/settings/dt=1e-400"}, "must be greater than 0, not 0 (1e-400 underflows)");
    expectRefused({"run", scene_, "--set", "/settings/dt=NaN"}, "--set /settings/dt=NaN: NaN is no JSON number");
    expectRefused({"run", scene_, "--set", "/settings/dt=1e30", "--steps", "1"},
                  "for dt = 1e+30 and for 1/dt; --precision f64 takes more");
}

TEST_F(CommandLimits, OutputThatIsLost) {
    const std::string query =
        in_.write("q.jsonl",
                  R"({"id": 1, "a": {"vertices": [[0, 0]], "radius": 1, "sweep": {"localCenter": [0, 0], "c0": [0, 0],)"
                  R"( "c1": [0, 0], "a0": 0, "a1": 0}}, "b": {"vertices": [[0, 0]], "radius": 1, "sweep":)"
                  R"( {"localCenter": [0, 0], "c0": [5, 0], "c1": [0, 0], "a0": 0, "a1": 0}}, "tMax": 1})"
                  "\n");
    const std::string program = SWEPT_PROGRAM;
    for (const std::string& arguments :
         {"toi " + query, "distance " + query, "run " + scene_ + " --steps 1",
          "run " + scene_ + " --steps 100000000 --csv -", std::string("scenes"), std::string("--help")}) {
        const auto lost = runProgram("sh", {"-c", "exec '" + program + "' " + arguments + " > /dev/full"});
        EXPECT_EQ(lost.exitCode, 2) << arguments;
        EXPECT_EQ(lost.err, "swept: standard output cannot be written\n") << arguments;
    }
}

// A word it does not know must not install all there is.
TEST(SetupScript, TakesTheWordsItKnows) {
    const std::string script = SWEPT_SOURCE_ROOT "/tools/setup.sh";
    const auto help = runProgram("bash", {script, "--help"});
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.out.substr(0, 22), "usage: tools/setup.sh ");
    for (const char* const word : {"--list", "everything"}) {
        const auto unknown = runProgram("bash", {script, word});
        EXPECT_EQ(unknown.exitCode, 1) << word;
        EXPECT_NE(unknown.err.find("usage: tools/setup.sh "), std::string::npos) << unknown.err;
    }
}

}  // namespace
}  // namespace swept
