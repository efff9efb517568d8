#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_reader.h>

#include "run_program.h"

namespace swept {
namespace {

TEST(CommandScenes, TheDoctorWarnsOfWhatRunRefuses) {
    const std::vector<std::string> scene{"falling-shapes", "--set", "/gravity=[0,-1e30]"};
    std::vector<std::string> inspect{"inspect", "--strict"};
    inspect.insert(inspect.end(), scene.begin(), scene.end());
    const ProgramResult result = runSwept(inspect);
    EXPECT_EQ(result.exitCode, 1);
    EXPECT_NE(result.out.find("warning [refused] /gravity\n"), std::string::npos) << result.out;
    std::vector<std::string> run{"run"};
    run.insert(run.end(), scene.begin(), scene.end());
    expectRefused(run, "/gravity: ");
    // A step longer than all of the time matters to a run alone.
    EXPECT_EQ(runSwept({"inspect", "falling-shapes", "--set", "/settings/dt=100"}).err, "");
}

TEST(CommandScenes, ListsEveryScene) {
    const auto result = runSwept({"scenes"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    for (const BuiltinScene& scene : builtinScenes()) {
        EXPECT_NE(result.out.find(scene.name), std::string::npos) << scene.name;
        EXPECT_NE(result.out.find(scene.purpose), std::string::npos) << scene.name;
    }
    EXPECT_GE(builtinScenes().size(), 10u);
}

/// Every command runs a built-in scene for as long as the list says, and any other for ten seconds.
TEST(CommandScenes, RunForAsLongAsTheListSays) {
    EXPECT_NE(runSwept({"scenes"}).out.find("pass through it (1 s)\n"), std::string::npos);
    const auto run = runSwept({"run", "continuous-off"});
    EXPECT_NE(run.out.find(": 60 steps of 0.01667 s = 1 s,"), std::string::npos) << run.out;
    EXPECT_NE(runSwept({"modes", "continuous-off"}).out.find("continuous-off: 60 steps"), std::string::npos);
    const auto longer = runSwept({"run", "continuous-off", "--duration", "2"});
    EXPECT_NE(longer.out.find(": 120 steps "), std::string::npos) << longer.out;
    const std::string scene = runSwept({"scenes", "--json", "continuous-off"}).out;
    const auto piped = runSwept({"run", "-"}, scene);
    EXPECT_NE(piped.out.find(": 600 steps "), std::string::npos) << piped.out;
}

TEST(CommandScenes, PrintsASceneThatReadsBack) {
    for (const BuiltinScene& scene : builtinScenes()) {
        const auto result = runSwept({"scenes", "--json", scene.name});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        const SceneResult read = readScene(result.out, scene.name);
        ASSERT_TRUE(read.scene) << read.error.text();
        EXPECT_EQ(writeScene(*read.scene), writeScene(scene.make())) << scene.name;
    }
}

TEST(CommandHelp, NamesCommandsAndOptions) {
    const auto help = runSwept({"--help"});
    EXPECT_EQ(help.exitCode, 0);
    for (const char* const word :
         {"run", "scenes", "toi", "distance", "compare", "inspect", "modes", "tune", "bench", "--version"}) {
        EXPECT_NE(help.out.find(word), std::string::npos) << word;
    }
    EXPECT_EQ(help.out.find("__peer"), std::string::npos);
    const auto runHelp = runSwept({"run", "--help"});
    EXPECT_EQ(runHelp.exitCode, 0);
    for (const char* const word :
         {"--duration", "--steps", "--set", "--png", "--every", "--size", "--webp", "--sheet", "--trails", "--csv",
          "--events", "--report", "--precision", "--threads", "--contacts", "--velocities", "--ghosts"}) {
        EXPECT_NE(runHelp.out.find(word), std::string::npos) << word;
    }
    EXPECT_NE(runHelp.out.find("Another name of --report"), std::string::npos) << runHelp.out;
    EXPECT_EQ(runSwept({"--version"}).out.substr(0, 6), "swept ");
}

}  // namespace
}  // namespace swept
