#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "csv_records.h"
#include "refused_runs.h"
#include "run_program.h"
#include "small_scenes.h"

// Where pictures look: --view and --follow.

namespace swept {
namespace {

using Words = std::vector<std::string>;

/// The picture that a command draws of the ball's scene after so many steps.
std::string pictureOf(const std::string& command, const std::string& steps, const Words& options) {
    const ScratchDirectory scratch;
    const bool isRun = command == "run";
    Words arguments{command, scratch.write("ball.json", kBallScene), "--steps", steps, "--size", "96x64"};
    arguments.insert(arguments.end(), {"--png", scratch.path(isRun ? "frames" : "picture.png")});
    if (isRun) { arguments.insert(arguments.end(), {"--every", steps}); }
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = runSwept(arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const std::string digits = "000000" + steps;
    return scratch.read(isRun ? "frames/frame_" + digits.substr(digits.size() - 6) + ".png" : "picture.png");
}

/// "X,Y,HEIGHT" with the place of the ball after 40 steps, and so much beside it.
std::string viewOfBall(double beside, const std::string& height) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto csv = runSwept({"run", scene, "--steps", "40", "--csv", "-", "--csv-every", "40"}).out;
    const auto records = recordsOf(csv);
    // Shortest decimals: what is added has to be a number that keeps them exact.
    std::ostringstream text;
    text.precision(17);
    text << numberIn(records, records.size() - 1, "x") + beside << ',' << numberIn(records, records.size() - 1, "y")
         << ',' << height;
    return text.str();
}

TEST(CommandCamera, ShowsWhatAViewOfTheSceneWould) {
    const std::string member = R"(/view={"center": [-1.5, 2], "height": 6})";
    for (const char* const command : {"run", "compare"}) {
        const std::string seen = pictureOf(command, "40", {"--view", "-1.5,2,6"});
        EXPECT_EQ(seen, pictureOf(command, "40", {"--set", member})) << command;
        EXPECT_NE(seen, pictureOf(command, "40", {})) << command;
        EXPECT_EQ(seen, pictureOf(command, "40", {"--set", R"(/view={"height": 1})", "--view=-1.5,2,6"})) << command;
    }
    // Panels show more than the scene's view where that would cut off bodies: not more than they are asked for.
    EXPECT_NE(pictureOf("modes", "40", {"--view", "0,0,1"}), pictureOf("modes", "40", {}));
    EXPECT_EQ(pictureOf("modes", "40", {"--view", "9.25,0,2"}),
              pictureOf("modes", "40", {"--view", "9.25,0,2", "--set", R"(/view={"height": 30})"}));
}

TEST(CommandCamera, FollowsABody) {
    const std::string beside = viewOfBall(0.5, "3");
    for (const char* const command : {"run", "compare", "modes"}) {
        EXPECT_EQ(pictureOf(command, "40", {"--view", "0.5,0,3", "--follow", "ball"}),
                  pictureOf(command, "40", {"--view", beside}))
            << command;
        // 8 times a radius of half a metre.
        EXPECT_EQ(pictureOf(command, "40", {"--follow", "ball"}),
                  pictureOf(command, "40", {"--view", viewOfBall(0, "4")}))
            << command;
    }
}

TEST(CommandCamera, HoldsForSheetsAndAnimations) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto draw = [&](const std::string& name, const Words& options) {
        Words arguments{"run", scene, "--steps", "8", "--every", "4", "--size", "96x64", "--sheet", "2"};
        arguments.insert(arguments.end(), {"--png", scratch.path(name), "--webp", scratch.path(name + ".webp")});
        arguments.insert(arguments.end(), options.begin(), options.end());
        EXPECT_EQ(runSwept(arguments).exitCode, 0);
    };
    draw("whole", {});
    draw("view", {"--view", "0,5,4"});
    draw("follow", {"--follow", "ball"});
    for (const char* const ending : {".webp", "/sheet.png"}) {
        EXPECT_NE(scratch.read(std::string("view") + ending), scratch.read(std::string("whole") + ending)) << ending;
        EXPECT_NE(scratch.read(std::string("follow") + ending), scratch.read(std::string("view") + ending)) << ending;
    }
}

TEST(CommandCamera, FollowsABodyThatFliesAway) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    for (const char* const speed : {"1e9", "1e17"}) {
        const auto result = runSwept({"run", scene, "--steps", "64", "--every", "64", "--size", "96x64", "--png",
                                      scratch.path("out"), "--follow", "ball", "--trails", "--velocities", "--set",
                                      "/bodies/1/velocity=[" + std::string(speed) + ", 0]"});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        EXPECT_GT(scratch.read("out/frame_000064.png").size(), 100u);
    }
}

class CommandCameraError : public RefusedRuns {};

TEST_F(CommandCameraError, ViewsThatMakeNoSense) {
    const auto expectViewRefused = [&](const std::string& view, const std::string& reason) {
        for (const char* const command : {"run", "compare", "modes"}) {
            expectNothingWritten({command, scene_, "--png", out_.path("a"), "--view", view},
                                 "swept: --view " + view + ": " + reason);
        }
    };
    for (const char* const view : {"1,2", "1,2,3,4", "a,b,c", "1,2,3m", "1 2 3", ",,", "1,2,"}) {
        expectViewRefused(view, "expected X,Y,HEIGHT in metres, as 0,2.5,10");
    }
    for (const char* const view : {"nan,0,1", "0,inf,1", "0,0,nan", "4e38,0,1", "0,0,1e999"}) {
        expectViewRefused(view, "must be finite numbers, at most 3e38");
    }
    for (const char* const view : {"0,0,0", "0,0,-1", "0,0,1e-39"}) {
        expectViewRefused(view, "the height must be greater than 0");
    }
    expectNothingWritten({"run", scene_, "--png", out_.path("a"), "--view", ""}, "--view");
}

TEST_F(CommandCameraError, BodiesThatAreNotThere) {
    for (const char* const command : {"run", "compare", "modes"}) {
        const Words drawn{command, scene_, "--png", out_.path("a"), "--follow"};
        const auto expectBodyRefused = [&](const std::string& name, const std::string& reason) {
            Words arguments = drawn;
            arguments.push_back(name);
            expectNothingWritten(arguments, reason);
        };
        expectBodyRefused("bal", "--follow bal: the scene has no body of that name; did you mean \"ball\"?");
        expectBodyRefused("nobody", "no body of that name; known here: floor, ball\n");
        expectBodyRefused("", "--follow");
    }
    expectNothingWritten({"run", "pyramid", "--png", out_.path("a"), "--follow", "nobody at all"},
                         "body6, body7 and 204 more\n");
}

TEST_F(CommandCameraError, WithoutAPicture) {
    for (const Words& camera : {Words{"--view", "0,0,1"}, Words{"--follow", "ball"}}) {
        expectRefused({"run", scene_, camera[0], camera[1]}, "swept: " + camera[0] + " needs --png or --webp\n");
        expectRefused({"compare", scene_, camera[0], camera[1]}, camera[0] + " needs --png");
        expectRefused({"modes", scene_, camera[0], camera[1]}, camera[0] + " needs --png");
    }
}

}  // namespace
}  // namespace swept
