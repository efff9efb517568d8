#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "refused_runs.h"
#include "run_program.h"
#include "small_scenes.h"

namespace swept {
namespace {

class CommandError : public RefusedRuns {
protected:
    void expectRunRefused(std::vector<std::string> arguments, const std::string& reason) {
        arguments.insert(arguments.begin(), "run");
        for (const char* const output : {"--csv", "--events", "--report"}) {
            if (std::find(arguments.begin(), arguments.end(), output) != arguments.end()) { continue; }
            arguments.insert(arguments.end(), {output, out_.path(output + 2)});
        }
        if (std::find(arguments.begin(), arguments.end(), "--png") == arguments.end()) {
            arguments.insert(arguments.end(), {"--png", out_.path("pictures")});
        }
        expectNothingWritten(arguments, reason);
    }
};

TEST_F(CommandError, DurationAndStepsTogether) {
    expectRunRefused({scene_, "--duration", "1", "--steps", "2"}, "not both");
}

TEST_F(CommandError, LengthsThatMakeNoSense) {
    expectRunRefused({scene_, "--steps=-1"}, "--steps");
    expectRunRefused({scene_, "--steps", "1.5"}, "--steps");
    expectRunRefused({scene_, "--duration", "nan"}, "--duration");
    expectRunRefused({scene_, "--duration", "1e300"}, "--duration");
    expectRunRefused({scene_, "--duration=-1"}, "--duration");
    expectRunRefused({scene_, "--duration", "soon"}, "swept: --duration: soon is not a number");
    expectRunRefused({scene_, "--duration", "1s"}, "swept: --duration: 1s is not a number");
    expectRunRefused({scene_, "--duration="}, "--duration");
}

TEST_F(CommandError, ScenesThatAreNotThere) {
    expectRunRefused({"piramid"},
                     "piramid: no such file, and no built-in scene of that name; did you mean \"pyramid\"?");
    expectRunRefused({in_.path("missing.json")}, "no such file");
    expectRunRefused({"--steps", "1"}, "scene");
}

TEST_F(CommandError, NamesFilePointerAndReason) {
    const std::string bad =
        in_.write("bad.json", R"({"bodies": [{"type": "dynamic", "shapes": [{"circle": {"radius": -1}}]}]})");
    expectRunRefused({bad}, "swept: " + bad + ": /bodies/0/shapes/0/circle/radius: ");
    const std::string syntax = in_.write("syntax.json", "{\"bodies\": [}");
    expectRunRefused({syntax}, syntax + ": line 1, column");
    const std::string unknown = in_.write("unknown.json", R"({"bodys": []})");
    expectRunRefused({unknown}, unknown + ": /bodys: ");
    const std::string list = in_.write("list.json", "[]");
    expectRunRefused({list}, list + ": a scene must be an object");
}

TEST_F(CommandError, OverridesThatDoNotFit) {
    expectRunRefused({scene_, "--set", "settings"}, "/pointer=value");
    expectRunRefused({scene_, "--set", "/settings/dt=-1"}, "/settings/dt");
    expectRunRefused({scene_, "--set", "/settings/dt={"}, "/settings/dt");
    expectRunRefused({scene_, "--set", "/nothing/here=1"}, "/nothing");
    expectRunRefused({scene_, "--set", "/bodies/9/angle=1"}, "/bodies/9");
}

TEST_F(CommandError, PlacesThatCannotBeWritten) {
    expectRunRefused({scene_, "--csv", out_.path("missing/a.csv")}, "--csv " + out_.path("missing/a.csv"));
    expectRunRefused({scene_, "--report", "/proc/no_report.json"}, "--report /proc/no_report.json");
    expectRunRefused({scene_, "--png", "/proc/no_pictures"}, "--png /proc/no_pictures");
    expectRunRefused({scene_, "--png", scene_ + "/below"}, "--png");
    for (const char* const flag : {"--csv", "--events", "--report", "--png", "--webp"}) {
        expectRunRefused({scene_, flag, "-"},
                         "swept: " + std::string(flag) + " -: nothing is written to standard output");
    }
    expectRefused({"inspect", scene_, "--json", "-"}, "--json -: nothing is written to standard output");
    expectRefused({"tune", scene_, "--max-error", "penetration=1", "--out", "-"},
                  "--out -: nothing is written to standard output");
    expectRefused({"envelope", "--coarse", "--out", "-"}, "--out -: nothing is written to standard output");
    expectRunRefused({scene_, "--csv", scene_}, "would overwrite the input");
    EXPECT_EQ(in_.read("ball.json"), kBallScene);
    expectRefused({"modes", scene_, "--png", scene_}, "would overwrite the input");
    EXPECT_EQ(in_.read("ball.json"), kBallScene);
    expectRunRefused({scene_, "--csv", out_.path("same"), "--events", out_.path("same")}, "already the file of --csv");
}

TEST_F(CommandError, PicturesThatMakeNoSense) {
    expectRunRefused({scene_, "--size", "1280"}, "--size 1280");
    expectRunRefused({scene_, "--size", "0x10"}, "--size 0x10");
    expectRunRefused({scene_, "--size", "1280x720px"}, "--size");
    expectRunRefused({scene_, "--size", "99999999999x720"}, "--size");
    expectRunRefused({scene_, "--every", "0"}, "--every");
    expectRunRefused({scene_, "--sheet", "-1"}, "--sheet");
    expectRefused({"run", scene_, "--sheet", "4"}, "--sheet: needs --png");
    expectRefused({"run", scene_, "--trails"}, "need --png or --webp");
}

TEST_F(CommandError, OtherArgumentsThatMakeNoSense) {
    expectRunRefused({scene_, "--precision", "f16"}, "--precision");
    expectRunRefused({scene_, "--threads", "0"}, "--threads");
    expectRunRefused({scene_, "--unheard-of"}, "swept: --unheard-of: no such option");
    expectRunRefused({scene_, "--unheard-of=3"}, "swept: --unheard-of: no such option");
    expectRunRefused({"--unheard-of", "3", scene_}, "swept: --unheard-of: no such option");
    expectRunRefused({scene_, "second.json"}, "swept: second.json: one argument too many");
    expectRefused({"inspect", scene_, "--precision", "f64"}, "swept: --precision: no such option");
    expectRefused({"--unheard-of"}, "swept: --unheard-of: no such option");
    expectRefused({"run", "--unheard-of"}, "swept: --unheard-of: no such option");
    expectRefused({}, "swept: no command given (\"swept --help\" lists them)");
    expectRefused({"bench", "--unheard-of"}, "swept: --unheard-of: no such option");
    expectRefused({"fly"}, "fly: no such command");
    expectRefused({"bench", "world", "--size", "nan"}, "nan is not a number");
    expectRefused({"bench", "world", "--write", out_.path("scenes"), "--csv", out_.path("a.csv")}, "--write");
    expectRefused({"modes", scene_, "--size", "big"}, "--size");
    expectRefused({"scenes", "--json", "piramid"}, "did you mean \"pyramid\"?");
    expectRefused({""}, "no such command");
    expectRefused({"toi", in_.path("missing.jsonl")}, in_.path("missing.jsonl"));
    expectRefused({"toi", "--method", "guess"}, "--method guess");
    expectRefused({"distance", "--precision", "f16"}, "--precision");
    expectRefused({"compare", scene_, "--scale", "0"}, "--scale");
    expectRefused({"compare", scene_, "--scale", "big"}, "swept: --scale: big is not a number");
    expectRefused({"compare", scene_, "--png", out_.path("missing/a.png")}, "--png");
}

TEST_F(CommandError, TuneWithoutAnErrorToKeep) { expectRefused({"tune", scene_}, "--max-error"); }

}  // namespace
}  // namespace swept
