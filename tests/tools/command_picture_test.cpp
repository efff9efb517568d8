#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "../support/png_file.h"
#include "run_program.h"
#include "small_scenes.h"

namespace swept {
namespace {

/// Width and height from a PNG's header.
std::pair<std::uint32_t, std::uint32_t> pngSize(const std::string& bytes) {
    if (bytes.size() < 24 || bytes.substr(1, 3) != "PNG") { return {0, 0}; }
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) { value = value << 8 | static_cast<unsigned char>(bytes[at + i]); }
        return value;
    };
    return {number(16), number(20)};
}

std::size_t filesIn(const std::string& directory) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory)) { ++count; }
    return count;
}

TEST(CommandPictures, DrawsEveryNthStep) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result = runSwept({"run", scene, "--steps", "20", "--png", scratch.path("new/out"), "--every", "8",
                                  "--size", "160x90", "--contacts", "--velocities", "--ghosts", "--trails"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    for (const char* const name : {"frame_000000.png", "frame_000008.png", "frame_000016.png"}) {
        EXPECT_EQ(pngSize(scratch.read(std::string("new/out/") + name)), (std::pair{160u, 90u})) << name;
    }
    EXPECT_EQ(filesIn(scratch.path("new/out")), 3u);
    EXPECT_NE(scratch.read("new/out/frame_000000.png"), scratch.read("new/out/frame_000016.png")) << "the ball moves";
}

TEST(CommandPictures, DrawsEveryStepByDefault) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    ASSERT_EQ(runSwept({"run", scene, "--steps", "2", "--png", scratch.path("out"), "--size", "160x90"}).exitCode, 0);
    EXPECT_EQ(filesIn(scratch.path("out")), 3u);
}

TEST(CommandPictures, DrawsASheetAndAnAnimation) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result = runSwept({"run", scene, "--steps", "30", "--every", "10", "--png", scratch.path("out"),
                                  "--sheet", "6", "--webp", scratch.path("out.webp"), "--size", "320x180"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(filesIn(scratch.path("out")), 5u) << "four frames and the sheet";
    const auto [width, height] = pngSize(scratch.read("out/sheet.png"));
    EXPECT_GT(width, 320u);
    EXPECT_GT(height, 180u);
    const std::string webp = scratch.read("out.webp");
    ASSERT_GT(webp.size(), 100u);
    EXPECT_EQ(webp.substr(0, 4), "RIFF");
    EXPECT_EQ(webp.substr(8, 4), "WEBP");
    EXPECT_NE(webp.find("ANIM"), std::string::npos);
}

TEST(CommandPictures, WriteNamesWhereTheyAreAskedTo) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto pictureOf = [&](std::vector<std::string> options) {
        options.insert(options.begin(),
                       {"run", scene, "--steps", "0", "--size", "320x180", "--png", scratch.path("out")});
        EXPECT_EQ(runSwept(options).exitCode, 0);
        return scratch.read("out/frame_000000.png");
    };
    const std::string named = pictureOf({"--labels"});
    EXPECT_NE(named, pictureOf({}));
    EXPECT_NE(named, pictureOf({"--labels", "--set", "/bodies/ball/name=\"bullet\""}));
    EXPECT_EQ(pictureOf({}), pictureOf({"--set", "/bodies/ball/name=\"bullet\""}));
}

/// A run of two steps has three moments, however many are asked for.
TEST(CommandPictures, OfASheetAreAsLargeAsTheirNumberAllows) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto sizeOf = [&](const char* moments) {
        const auto result = runSwept({"run", scene, "--steps", "2", "--size", "1280x720", "--every", "2", "--png",
                                      scratch.path("out"), "--sheet", moments});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return pngSize(scratch.read("out/sheet.png"));
    };
    EXPECT_EQ(sizeOf("400"), sizeOf("3"));
}

/// Where nothing moves, moments differ in their captions alone.
TEST(CommandPictures, OfASheetTellTheirTimesOnce) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("still.json", R"({"bodies": [{"shapes": [{"circle": {"radius": 1}}]}]})");
    const auto sheetAfter = [&](const std::string& steps) {
        const auto result = runSwept(
            {"run", scene, "--steps", steps, "--size", "320x180", "--png", scratch.path("out"), "--sheet", "1"});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return test::readPng(scratch.path("out/sheet.png"));
    };
    const Image first = sheetAfter("10");
    const Image second = sheetAfter("50");
    ASSERT_EQ(first.rgb.size(), second.rgb.size());
    EXPECT_FALSE(first == second) << "the captions";
    constexpr int kGap = 8;  // around the tiles
    EXPECT_TRUE(std::equal(first.at(0, 0), first.at(0, kGap + 180), second.at(0, 0)));
}

/// A rope from above the picture to a ball that falls below it: all there is to see of the scene is what is drawn of
/// the joint.
std::string sceneWithRope(const std::string& joint) {
    return R"({"view": {"center": [0, 0], "height": 2}, "settings": {"dt": 0.015625}, "bodies": [
      {"name": "hook", "position": [0, 9], "shapes": [{"circle": {"radius": 0.1}}]},
      {"name": "ball", "type": "dynamic", "position": [0, -9], "shapes": [{"circle": {"radius": 0.1}}]}],
     "joints": [{"type": "filter", "bodyA": "hook", "bodyB": "ball"},
                {"bodyA": "hook", "bodyB": "ball", )" +
           joint + "}]}";
}

TEST(CommandPictures, ShowNoJointThatBroke) {
    const ScratchDirectory scratch;
    const std::string rope = R"("type": "distance", "anchorA": [0, 9], "anchorB": [0, -9])";
    const std::string whole = scratch.write("whole.json", sceneWithRope(rope));
    const std::string broken = scratch.write("broken.json", sceneWithRope(rope + R"(, "breakForce": 1e-3)"));
    const std::string none = scratch.write("none.json", sceneWithRope(R"("type": "filter")"));
    const auto pictureOf = [&](const std::string& command, const std::string& scene) {
        std::vector<std::string> arguments{command, scene, "--steps", "4", "--size", "90x90"};
        const bool isRun = command == "run";
        arguments.insert(arguments.end(), {"--png", scratch.path(isRun ? "frames" : "picture.png")});
        if (isRun) { arguments.insert(arguments.end(), {"--events", scratch.path("events.jsonl")}); }
        const auto result = runSwept(arguments);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return scratch.read(isRun ? "frames/frame_000004.png" : "picture.png");
    };
    for (const char* const command : {"compare", "modes", "run"}) {
        const std::string empty = pictureOf(command, none);
        EXPECT_NE(pictureOf(command, whole), empty) << command << " draws joints";
        EXPECT_EQ(pictureOf(command, broken), empty) << command;
    }
    EXPECT_NE(scratch.read("events.jsonl").find(R"("type":"jointBreak","a":"hook","b":"ball")"), std::string::npos);
    EXPECT_NE(scratch.read("events.jsonl").find(R"("joint":1})"), std::string::npos) << "the filter is joint 0";
}

TEST(CommandPictures, ThatCannotBeWrittenNameTheirOptionAndLeaveDevicesAlone) {
    if (!std::filesystem::exists("/dev/full")) { GTEST_SKIP() << "this system has no /dev/full"; }
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    for (const char* const command : {"modes", "compare"}) {
        const auto result = runSwept({command, scene, "--steps", "1", "--size", "90x90", "--png", "/dev/full"});
        EXPECT_EQ(result.exitCode, 2) << command;
        EXPECT_EQ(result.err, "swept: --png /dev/full: No space left on device\n") << command;
    }
    const std::vector<std::string> run{"run", scene, "--steps", "1", "--size", "90x90", "--csv", scratch.path("a.csv")};
    std::vector<std::string> animated = run;
    animated.insert(animated.end(), {"--webp", "/dev/full"});
    EXPECT_EQ(runSwept(animated).err, "swept: --webp /dev/full: No space left on device\n");
    EXPECT_FALSE(scratch.has("a.csv"));
    std::filesystem::create_directory(scratch.path("frames"));
    std::filesystem::create_symlink("/dev/full", scratch.path("frames/frame_000001.png"));
    std::vector<std::string> drawn = run;
    drawn.insert(drawn.end(), {"--png", scratch.path("frames")});
    EXPECT_EQ(runSwept(drawn).err,
              "swept: --png " + scratch.path("frames/frame_000001.png") + ": No space left on device\n");
    EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(CommandPictures, CloserThanAMillisecondAreInSlowMotion) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto errorsOf = [&](const std::string& dt, const std::string& every) {
        const auto result = runSwept({"run", scene, "--steps", "4", "--set", "/settings/dt=" + dt, "--every", every,
                                      "--size", "32x32", "--webp", scratch.path("a.webp")});
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.err;
    };
    EXPECT_EQ(errorsOf("0.00025", "1"),
              "swept: warning: --webp: pictures 0.25 ms apart are shown for 1 ms each, 4 times as long as they took; "
              "--every 4 shows real time\n");
    EXPECT_EQ(errorsOf("0.00025", "4"), "");
    EXPECT_EQ(errorsOf("0.001", "1"), "");
}

TEST(CommandPictures, OfAnEarlierRunAreToldApart) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto placesOf = [&](const std::string& steps) {
        const std::string out =
            runSwept({"run", scene, "--steps", steps, "--every", "2", "--size", "32x32", "--png", scratch.path("out")})
                .out;
        return out.substr(out.find("pictures  "));
    };
    const std::string places = "pictures  " + scratch.path("out") + "/frame_*.png";
    EXPECT_EQ(placesOf("8"), places + '\n');
    EXPECT_EQ(placesOf("6"), places + " (and 1 picture of an earlier run)\n");
    EXPECT_EQ(placesOf("2"), places + " (and 3 pictures of an earlier run)\n");
    EXPECT_EQ(filesIn(scratch.path("out")), 5u) << "nothing is taken away";
}

TEST(CommandPictures, AFolderIsNotCalledAsAPicture) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    expectRefused({"run", scene, "--png", scratch.path("x.png")}, "x.png: is a directory for pictures");
    EXPECT_FALSE(scratch.has("x.png"));
    std::filesystem::create_directory(scratch.path("there.png"));
    EXPECT_EQ(runSwept({"run", scene, "--steps", "1", "--size", "32x32", "--png", scratch.path("there.png")}).exitCode,
              0);
}

TEST(CommandPictures, DrawNothingUnlessAskedTo) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    ASSERT_EQ(runSwept({"run", scene, "--steps", "2"}).exitCode, 0);
    EXPECT_EQ(filesIn(scratch.path("")), 1u);
}

}  // namespace
}  // namespace swept
