#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

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

TEST(CommandPictures, DrawNothingUnlessAskedTo) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    ASSERT_EQ(runSwept({"run", scene, "--steps", "2"}).exitCode, 0);
    EXPECT_EQ(filesIn(scratch.path("")), 1u);
}

}  // namespace
}  // namespace swept
