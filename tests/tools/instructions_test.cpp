#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

#include <swept/samples/scene_reader.h>
#include <swept/tools/worlds/bench_scene.h>

#include "run_program.h"

/// What a step costs, in instructions counted under callgrind: shows a slow-down without a stopwatch, on a busy machine
/// too. When one is meant, or a step became cheaper, take over what this prints into data/instructions.csv.

namespace swept {
namespace {

/// A line of data/instructions.csv.
struct Cost {
    std::string scene;
    double size = 0;
    std::string profile;
    int warmSteps = 0;
    double instructions = 0;  ///< of a step
};

std::vector<Cost> committedCosts() {
    std::ifstream file(SWEPT_INSTRUCTIONS);
    std::vector<Cost> costs;
    std::string line;
    std::getline(file, line);  // the head
    while (std::getline(file, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream fields(line);
        Cost& cost = costs.emplace_back();
        fields >> cost.scene >> cost.size >> cost.profile >> cost.warmSteps >> cost.instructions;
    }
    return costs;
}

/// Of all steps of a run. (What is around them, the start of the program above all, differs from run to run by up to
/// 1e6.)
double instructionsOf(const std::vector<std::string>& command) {
    const ScratchDirectory scratch;
    std::vector<std::string> arguments{"--tool=callgrind", "--callgrind-out-file=" + scratch.path("callgrind.out"),
                                       "--toggle-collect=swept::f32::World::step(double)"};
    arguments.insert(arguments.end(), command.begin(), command.end());
    const ProgramResult result = runProgram(SWEPT_VALGRIND, arguments);
    EXPECT_EQ(result.exitCode, 0) << result.err;
    std::smatch match;
    const bool isTold = std::regex_search(result.err, match, std::regex("Collected : ([0-9]+)"));
    EXPECT_TRUE(isTold) << result.err;
    return isTold ? std::stod(match[1]) : 0;
}

TEST(Instructions, OfAStepDoNotGrow) {
    constexpr int kSteps = 100;
    constexpr double kMostGrowth = 1.05;  // of other compilers and processors within that
    const std::vector<Cost> costs = committedCosts();
    ASSERT_FALSE(costs.empty());
    for (const Cost& cost : costs) {
        const ScratchDirectory scratch;
        SceneDescription scene = worlds::sceneNamed(cost.scene)->make(cost.size).scene;
        scene.settings.profile = cost.profile == "fast" ? SceneProfile::fast : SceneProfile::accurate;
        const std::string path = scratch.write("scene.json", writeScene(scene));
        const auto upTo = [&path](int steps) {
            return instructionsOf({SWEPT_PROGRAM, "run", path, "--steps", std::to_string(steps)});
        };
        const double now = (upTo(cost.warmSteps + kSteps) - upTo(cost.warmSteps)) / kSteps;
        std::cout << "[ COUNTED  ] " << cost.scene << ',' << cost.size << ',' << cost.profile << ',' << cost.warmSteps
                  << ',' << std::llround(now) << '\n';
        EXPECT_GT(now, 100) << cost.scene << " does nothing";
        EXPECT_LE(now, kMostGrowth * cost.instructions) << cost.scene << ", " << cost.profile;
    }
}

/// Whatever sleeps beside it.
TEST(Instructions, OfAStepAreThoseOfWhatIsAwake) {
    constexpr int kWarmSteps = 130;
    constexpr int kSteps = 200;
    for (const std::string profile : {"fast", "accurate"}) {
        const auto cost = [&profile](int crates) {
            const auto upTo = [&](int steps) {
                return instructionsOf({SWEPT_BESIDE_SLEEPERS, std::to_string(crates), std::to_string(steps), profile});
            };
            return (upTo(kWarmSteps + kSteps) - upTo(kWarmSteps)) / kSteps;
        };
        const double few = cost(100);
        const double many = cost(2'000);
        std::cout << "[ COUNTED  ] " << profile << ": " << few << " beside 100 crates, " << many << " beside 2000\n";
        EXPECT_GT(few, 10'000);
        EXPECT_LE(many, 1.05 * few);
    }
}

}  // namespace
}  // namespace swept
