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

/// Of a whole run, start and end included.
double instructionsOnce(const std::string& scene, int steps, const ScratchDirectory& scratch) {
    const ProgramResult result =
        runProgram(SWEPT_VALGRIND, {"--tool=callgrind", "--callgrind-out-file=" + scratch.path("callgrind.out"),
                                    SWEPT_PROGRAM, "run", scene, "--steps", std::to_string(steps)});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    std::smatch match;
    const bool isTold = std::regex_search(result.err, match, std::regex("Collected : ([0-9]+)"));
    EXPECT_TRUE(isTold) << result.err;
    return isTold ? std::stod(match[1]) : 0;
}

/// What starting takes differs from run to run by some 1e5, now and then by 1e6: the least of three.
double instructionsOf(const std::string& scene, int steps, const ScratchDirectory& scratch) {
    const double first = instructionsOnce(scene, steps, scratch);
    const double second = instructionsOnce(scene, steps, scratch);
    return std::min({first, second, instructionsOnce(scene, steps, scratch)});
}

TEST(Instructions, OfAStepDoNotGrow) {
    constexpr int kSteps = 100;
    constexpr double kMostGrowth = 1.05;     // of other compilers and processors within that
    constexpr double kNoise = 2e5 / kSteps;  // what is left of that
    const std::vector<Cost> costs = committedCosts();
    ASSERT_FALSE(costs.empty());
    for (const Cost& cost : costs) {
        const ScratchDirectory scratch;
        SceneDescription scene = worlds::sceneNamed(cost.scene)->make(cost.size).scene;
        scene.settings.profile = cost.profile == "fast" ? SceneProfile::fast : SceneProfile::accurate;
        const std::string path = scratch.write("scene.json", writeScene(scene));
        const double start = instructionsOf(path, cost.warmSteps, scratch);
        const double now = (instructionsOf(path, cost.warmSteps + kSteps, scratch) - start) / kSteps;
        std::cout << "[ COUNTED  ] " << cost.scene << ',' << cost.size << ',' << cost.profile << ',' << cost.warmSteps
                  << ',' << std::llround(now) << '\n';
        EXPECT_GT(now, 1000) << cost.scene << " does nothing";
        EXPECT_LE(now, kMostGrowth * cost.instructions + kNoise) << cost.scene << ", " << cost.profile;
    }
}

}  // namespace
}  // namespace swept
