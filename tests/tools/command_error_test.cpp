#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
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
    expectRunRefused({in_.path("ball")}, "did you mean \"" + scene_ + "\"?");
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
    for (const char* const flag : {"--png", "--webp"}) {
        expectRunRefused({scene_, flag, "-"}, "swept: " + std::string(flag) + " -: cannot write to standard output");
    }
    expectRunRefused({scene_, "--csv", "-", "--report", "-"}, "--report -: standard output is that of --csv already");
    // The tests' standard output is a file: states would overwrite what the command tells, or be overwritten by it.
    expectRunRefused({scene_, "--csv", "/dev/stdout"}, "--csv /dev/stdout: is where standard output goes");
    expectRefused({"tune", scene_, "--max-error", "penetration=1", "--out", "-"},
                  "--out -: cannot write to standard output");
    expectRefused({"tune", scene_, "--ablate", "--max-error", "penetration=1", "--out", scene_ + "/below"},
                  "--out " + scene_ + "/below: cannot be made a directory");
    expectRefused({"envelope", "--coarse", "--out", "-"}, "--out -: cannot write to standard output");
    expectRunRefused({scene_, "--csv", scene_}, "would overwrite the input");
    EXPECT_EQ(in_.read("ball.json"), kBallScene);
    expectRefused({"modes", scene_, "--png", scene_}, "would overwrite the input");
    EXPECT_EQ(in_.read("ball.json"), kBallScene);
    expectRunRefused({scene_, "--write-scene", scene_}, "--write-scene " + scene_ + ": would overwrite the input");
    EXPECT_EQ(in_.read("ball.json"), kBallScene);
    expectRunRefused({scene_, "--csv", "-", "--write-scene", "-"}, "--write-scene -: standard output is that of --csv");
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
    expectRefused({"run", scene_, "--trails"}, "swept: --trails needs --png or --webp\n");
    expectRefused({"run", scene_, "--labels"}, "swept: --labels needs --png or --webp\n");
    expectRunRefused({scene_, "--sheet", "0"}, "--sheet");
    expectRunRefused({scene_, "--sheet", "401"}, "--sheet");
    expectRunRefused({scene_, "--size", "9000x90"}, "--size 9000x90: sides must be between 16 and 8192");
    for (const char* const command : {"modes", "compare"}) {
        expectRefused({command, scene_, "--steps", "1", "--size", "90x90"}, "--size needs --png");
        expectRefused({command, scene_, "--steps", "1", "--size", "1x"}, "--size 1x: expected WIDTHxHEIGHT");
        expectRefused({command, scene_, "--steps", "1", "--size", "8193x90", "--png", out_.path("a.png")},
                      "--size 8193x90: sides must be between 16 and 8192");
    }
}

TEST_F(CommandError, StatesThatMakeNoSense) {
    expectRunRefused({scene_, "--csv-every", "0"}, "swept: --csv-every: must be at least 1");
    expectRunRefused({scene_, "--csv-every", "-3"}, "swept: --csv-every: must be at least 1");
    expectRunRefused({scene_, "--csv-every", "1.5"}, "--csv-every");
    expectRunRefused({scene_, "--csv-bodies", "floor,bal"},
                     "--csv-bodies bal: the scene has no body of that name; did you mean \"ball\"?");
    expectRunRefused({scene_, "--csv-bodies", ""}, "--csv-bodies");
    expectRefused({"run", scene_, "--csv-every", "2"}, "swept: --csv-every needs --csv\n");
    expectRefused({"run", scene_, "--csv-bodies", "ball"}, "swept: --csv-bodies needs --csv\n");
}

TEST_F(CommandError, FilesThatPicturesWouldOverwrite) {
    const std::string pictures = out_.path("pictures");
    const auto expectClash = [&](const std::vector<std::string>& further, const std::string& file) {
        std::vector<std::string> arguments{"--steps", "8", "--every", "4", "--png", pictures, "--csv", pictures + file};
        arguments.insert(arguments.begin(), scene_);
        arguments.insert(arguments.end(), further.begin(), further.end());
        expectRunRefused(arguments, "--csv " + pictures + file + ": is already a file of --png " + pictures);
    };
    expectClash({}, "/frame_000000.png");
    expectClash({}, "/frame_000008.png");
    expectClash({"--sheet", "4"}, "/sheet.png");
    const std::string scene = in_.write("frame_000004.png", kBallScene);
    expectRefused({"run", scene, "--steps", "8", "--png", in_.path("")}, "would overwrite the input");
    EXPECT_EQ(in_.read("frame_000004.png"), kBallScene);
    // What no picture of the run is called is free.
    for (const char* const free : {"/frame_000005.png", "/frame_000012.png", "/frame_4.png", "/sheet.png"}) {
        const ProgramResult result = runSwept({"run", scene_, "--steps", "8", "--every", "4", "--size", "16x16",
                                               "--png", pictures, "--csv", pictures + free});
        EXPECT_EQ(result.exitCode, 0) << free << result.err;
    }
}

TEST_F(CommandError, PicturesByTheNameOfAnotherFormat) {
    const std::string query = in_.write("q.jsonl", "{}");
    expectRefused({"compare", scene_, "--steps", "1", "--png", out_.path("a.jpg")}, "a.jpg: writes PNG, a name that ");
    expectRefused({"modes", scene_, "--steps", "1", "--png", out_.path("a.webp")}, "a.webp: writes PNG, a name that ");
    expectRunRefused({scene_, "--webp", out_.path("a.json")}, "a.json: writes WebP, a name that ends in .webp");
    EXPECT_TRUE(out_.isEmpty());
}

TEST_F(CommandError, ScenesThatCannotBeRead) {
    std::filesystem::create_symlink(in_.path("loop"), in_.path("loop"));
    expectRunRefused({in_.path("loop")}, in_.path("loop") + ": cannot be read: Too many levels of symbolic links");
    expectRefused({"toi", in_.path("none.jsonl")}, in_.path("none.jsonl") + ": cannot be read: No such file");
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
    // What was probably meant.
    expectRefused({"rnu"}, "swept: rnu: no such command; did you mean run?");
    expectRefused({"bench", "continous"}, "bench continous: no such command; did you mean continuous?");
    expectRunRefused({scene_, "--step", "3"}, "swept: --step: no such option; did you mean --steps?");
    expectRefused({"bench", "world", "--sceens", "rain"}, "--sceens: no such option; did you mean --scenes?");
    expectRefused({"bench", "world", "--size", "nan"}, "nan is not a number");
    expectRefused({"bench", "world", "--write", out_.path("scenes"), "--csv", out_.path("a.csv")}, "--write");
    expectRefused({"bench", "world", "--full", "--steps", "5"}, "--full");
    expectRefused({"bench", "world", "--write", out_.path("scenes"), "--steps", "5"}, "--write");
    expectRefused({"bench", "accuracy", "--plots", out_.path("plots")}, "--trade");
    for (const char* const seed : {"9223372036854775808", "18446744073709551615"}) {
        expectRefused({"bench", "toi", "--count", "1", "--seed", seed}, std::string(seed) + " is too large");
    }
    expectRefused({"bench", "effort", "--repeats", "0"}, "--repeats");
    expectRefused({"toi", "--precision", "f32"}, "swept: --precision: no such option");
    expectRefused({"modes", scene_, "--size", "big"}, "--size");
    expectRefused({"scenes", "--json", "piramid"}, "did you mean \"pyramid\"?");
    expectRefused({"scenes", "--json", "foo"}, "no built-in scene of that name (\"swept scenes\" lists them)");
    expectRefused({"scenes", "pyramid"}, "pyramid: one argument too many; did you mean --json pyramid?");
    expectRefused({"scenes", "--json", "pyramid", "car"}, "car: one argument too many (--help tells");
    expectRefused({""}, "no such command");
    expectRefused({"toi", in_.path("missing.jsonl")}, in_.path("missing.jsonl"));
    expectRefused({"toi", "--method", "guess"}, "swept: --method: must be one of discrete, rayCast, ");
    expectRefused({"distance", "--precision", "f16"}, "--precision");
    expectRefused({"distance", "--method", "gjk"}, "swept: --method: no such option");
    expectRefused({"compare", scene_, "--scale", "0"}, "--scale");
    expectRefused({"compare", scene_, "--scale", "big"}, "swept: --scale: big is not a number");
    expectRefused({"compare", scene_, "--png", out_.path("missing/a.png")}, "--png");
}

/// In the same words, whoever reads the option.
TEST_F(CommandError, ChoicesAndRanges) {
    expectRefused({"bench", "world", "--engines", "steam"},
                  "swept: --engines: must be one of fast f32, accurate f32, ");
    expectRefused({"bench", "world", "--scenes", "nowhere"}, "beams, not nowhere\n");
    expectRefused({"bench", "world", "--of", "mean"}, "swept: --of: must be one of median, fastest, not mean\n");
    expectRefused({"bench", "threads", "--profile", "slow"}, "--profile: must be one of accurate, fast, not slow\n");
    expectRefused({"bench", "accuracy", "--scenes", "stack-12"}, " names, not stack-12; did you mean stack-1");
    expectRefused({"run", scene_, "--precision", "f16"}, "swept: --precision: must be one of f32, f64, not f16");
    expectRefused({"distance", "--precision", "f16"}, "swept: --precision: must be one of f32, f64, not f16");
    expectRefused({"toi", "--generate", "nothing"}, "swept: --generate: must be one of generic, ");
    expectRefused({"envelope", "--slice", "nothing"}, "swept: --slice: must be one of ");
    expectRefused({"run", scene_, "--threads", "0"}, "swept: --threads: must be between 1 and ");
    expectRefused({"bench", "world", "--size", "0"}, "swept: --size: must be between 1e-04 and 100, not 0\n");
    expectRefused({"bench", "toi", "--seed", "-1"},
                  "swept: --seed: must be a whole number, written in digits, not -1\n");
    expectRefused({"toi", "--generate", "generic", "--count", "0"}, "swept: --count: must be at least 1, not 0\n");
}

/// No list of ninety names among the options; what is no name lists them.
TEST_F(CommandError, HelpStaysShort) {
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"bench", "world"}, {"bench", "accuracy"}, {"bench", "threads"}, {"run"}}) {
        std::vector<std::string> arguments = command;
        arguments.emplace_back("--help");
        const std::string help = runSwept(arguments).out;
        std::size_t lists = 0;
        for (std::size_t at = help.find('{'); at != std::string::npos; at = help.find('{', at + 1), ++lists) {
            EXPECT_LT(help.find('}', at) - at, 90u) << help.substr(at, 200);
        }
        EXPECT_GT(lists, 0u) << command.back();
    }
    expectRefused({"bench", "accuracy", "--scenes", "*"}, "must be one of stacks, stack-10, stack-50, ");
}

TEST_F(CommandError, TuneWithoutAnErrorToKeep) { expectRefused({"tune", scene_}, "--max-error"); }

}  // namespace
}  // namespace swept
