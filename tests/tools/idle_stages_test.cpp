#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

#include "callgrind_lines.h"
#include "run_program.h"

/// "A stage without inputs costs nothing": instructions of a step, counted line by line. What looks at every body or
/// contact anyway, and finds out in passing who needs which stage (the roles of bodies, the solve), is a stage of its
/// own: its comparisons are not those of the stage that is not needed then.

namespace swept {
namespace {

constexpr int kBodies = 40;

/// Towers of forty boxes that glide along a floor (at rest they would be held, and pay for nothing), or discs that roll
/// along it; no joints, restitution, sensors, nothing fast, sleep off.
std::string idleScene(const std::string& mode = "subStep", bool rolls = false) {
    std::string text = R"({"settings": {"sleep": false, "continuous": ")" + mode + R"("}, "bodies": [
 {"name": "floor", "position": [0, -0.5], "shapes": [{"box": {"half": [40, 0.5]}, "friction": )" +
                       std::string(rolls ? "0.6" : "0") + "}]}";
    for (int i = 0; i < kBodies; ++i) {
        const double x = rolls ? i * 1.5 - 30 : i / 4 * 1.5 - 7;
        const double y = rolls ? 0.5 : i % 4 + 0.5;
        text += ",\n {\"type\": \"dynamic\", \"position\": [" + std::to_string(x) + ", " + std::to_string(y) + "], ";
        text += rolls ? R"("velocity": [0.5, 0], "angularVelocity": -1, "shapes": [{"circle": {"radius": 0.5}}]})"
                      : R"("velocity": [0.5, 0], "shapes": [{"box": {"half": [0.5, 0.5]}}]})";
    }
    return text + "]}";
}

/// What belongs to a stage: all lines of some files, the functions of some names, and single lines that name the stage.
struct Stage {
    const char* name;
    std::regex files;      ///< of paths from the root of the sources
    std::regex functions;  ///< of names
    std::regex lines;      ///< of the text of a line, in engine/ and solver/
};

std::vector<Stage> stages() {
    const std::regex none("^$");
    return {
        {"joints", std::regex("solver/(joint_rows|[a-z]+_constraint|joint_constraint).*|engine/(joint|world_joint).*"),
         std::regex(".*[jJ]oint.*"), std::regex("[jJ]oints?\\b")},
        {"restitution", std::regex("solver/(impact|reflect_impacts).*"), std::regex("listBouncing|reflect.*|footingOf"),
         std::regex("bouncing_|bouncyShapes|reflectImpacts|kBounces")},
        {"sensors", std::regex("engine/mode_sensors.*"), std::regex("sweepSensors"),
         std::regex("sensorS|sweepSensors")},
        {"sweeps",
         std::regex("engine/(stage_continuous|stage_islands|island_advance|island_contacts|clash|flight|free_path|"
                    "bullets|sweep_obstacles).*"),
         std::regex("sweepFastBodies"), std::regex("fastIslands|anyFast|anyFlung\\)")},
        {"speedLimit, speculative", std::regex("engine/mode_sp.*"), std::regex("anchorAhead|countAhead"),
         std::regex("world\\.watched")},
        {"sleep", none, std::regex("putToSleep|countRest|isTired|hardlyMoved|fallAsleep|keepAwake.*|restTimeOf"),
         std::regex("putToSleep")}};
}

/// Functions that find out who needs what (roles, efforts, who may be settled), and lines that are there with or
/// without joints: calls of what is solved, coloured and listed anyway.
const std::regex kFindsOut(
    "roleOf|isFlyer|assignRoles|noteContact|resetBody|begin|finish|colourContacts|assignEfforts|addContactsAndJoints|"
    "isTree|isCrowd|loadOf|addBody|effortFor|solveTiedBodies|listCandidates");
const std::regex kCalls(
    "void |counters|countSolve\\(|solveGroup\\(|solver\\.solve\\(|clearAllButJoints|kJoints[>,]|"
    "colourAhead\\(|isListed_ =|solveWith<");

struct SourceLine {
    std::string text;
    std::string function;  ///< in which it stands, as far as its definition begins at the first column
};

std::vector<SourceLine> readSource(const std::string& path) {
    std::vector<SourceLine> lines{{}};
    std::ifstream file(path);
    const std::regex definition("^[A-Za-z].*?(?:[a-z]+::)*([A-Za-z]+)\\(.*\\{$|^[A-Za-z].*?([A-Za-z]+)\\([^;]*$");
    std::string function;
    for (std::string text; std::getline(file, text);) {
        std::smatch match;
        if (std::regex_search(text, match, definition)) { function = match[1].matched ? match[1] : match[2]; }
        lines.push_back({text, function});
        if (text == "}") { function.clear(); }
    }
    return lines;
}

LineCosts costsOf(const std::string& scene, int steps, const ScratchDirectory& scratch) {
    const std::string out = scratch.path("callgrind." + std::to_string(steps));
    const ProgramResult result =
        runProgram(SWEPT_VALGRIND, {"--tool=callgrind", "--callgrind-out-file=" + out, SWEPT_PROGRAM, "run", scene,
                                    "--steps", std::to_string(steps)});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    return readCallgrind(scratch.read("callgrind." + std::to_string(steps)));
}

TEST(IdleStages, CallgrindFilesAreRead) {
    const LineCosts costs = readCallgrind(
        "events: Ir\nfl=(1) a.cpp\nfn=(1) main\n10 5\n+2 7\ncfi=(2) b.h\ncfn=(2) f\ncalls=1 3\n* 100\n"
        "fi=(2)\n4 9\nfe=(1)\n12 1\n\nfn=(2)\nfl=(2)\n-1 30\n");
    EXPECT_EQ(costs.at({"a.cpp", 10}), 5);
    EXPECT_EQ(costs.at({"a.cpp", 12}), 8) << "without the call";
    EXPECT_EQ(costs.at({"b.h", 4}), 9);
    EXPECT_EQ(costs.at({"b.h", 11}), 30);
}

/// Each way in which joints may matter (new ones, driven ones, loads at rest, lent energy, chains adrift, …) has a
/// comparison of its own in front of it: thirteen by now, of two or three instructions.
TEST(IdleStages, CostAtMostFortyInstructionsAStep) {
    constexpr int kSteps = 20;
    constexpr double kMostInstructions = 40;
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("idle.json", idleScene());
    const LineCosts few = costsOf(scene, kSteps, scratch);
    LineCosts more = costsOf(scene, 2 * kSteps, scratch);
    for (const auto& [line, cost] : few) { more[line] -= cost; }  // what is left is twenty steps, without the start

    const std::string root = std::string(SWEPT_SOURCE_ROOT) + '/';
    std::map<std::string, std::vector<SourceLine>> sources;
    std::map<std::string, double> perStep;
    std::map<std::string, std::string> told;
    double all = 0;
    for (const auto& [line, cost] : more) {
        const std::string file = std::filesystem::path(line.first).lexically_normal().string();
        const std::string path = file.starts_with(root) ? file.substr(root.size()) : std::string();
        if (!path.starts_with("engine/") && !path.starts_with("solver/")) { continue; }
        std::vector<SourceLine>& source = sources[path];
        if (source.empty()) { source = readSource(root + path); }
        const double instructions = static_cast<double>(cost) / kSteps;
        all += instructions;
        const SourceLine& here = source.at(static_cast<std::size_t>(line.second));
        for (const Stage& stage : stages()) {
            const bool isSolverOfContacts = path.starts_with("solver/contact_constraint");
            const bool isOther = isSolverOfContacts || std::regex_match(here.function, kFindsOut) ||
                                 std::regex_search(here.text, kCalls);
            const bool belongs =
                !isOther && (std::regex_match(path, stage.files) || std::regex_match(here.function, stage.functions) ||
                             std::regex_search(here.text, stage.lines));
            if (!belongs || cost == 0) { continue; }
            perStep[stage.name] += instructions;
            told[stage.name] += '\n' + path + ':' + std::to_string(line.second) + ": " + std::to_string(instructions) +
                                "  " + here.text;
        }
    }
    EXPECT_GT(all, 50'000) << "the lines of the step were not found";
    for (const Stage& stage : stages()) {
        std::cout << "[ COUNTED  ] " << stage.name << ": " << perStep[stage.name] << " instructions a step\n";
        EXPECT_LE(perStep[stage.name], kMostInstructions) << stage.name << told[stage.name];
    }
}

/// Of the engine and the solver, without the start. (The rest of the program is not the same twice: a library measures
/// its clock.)
double instructionsAStep(const std::string& sceneText, const ScratchDirectory& scratch) {
    constexpr int kSteps = 20;
    const std::string scene = scratch.write("counted.json", sceneText);
    const auto sum = [&](int steps) {
        double all = 0;
        for (const auto& [line, cost] : costsOf(scene, steps, scratch)) {
            const std::string file = std::filesystem::path(line.first).lexically_normal().string();
            all += file.starts_with(SWEPT_SOURCE_ROOT) ? static_cast<double>(cost) : 0;
        }
        return all;
    };
    return (sum(2 * kSteps) - sum(kSteps)) / kSteps;
}

/// What the default mode costs more than mode `off` where nothing is fast.
TEST(IdleStages, ContinuousCollisionCostsAtMostTenInstructionsASlowBody) {
    constexpr double kMostInstructions = 10;
    const ScratchDirectory scratch;
    for (const bool rolls : {false, true}) {
        const double off = instructionsAStep(idleScene("off", rolls), scratch);
        const double on = instructionsAStep(idleScene("subStep", rolls), scratch);
        const double more = (on - off) / kBodies;
        std::cout << "[ COUNTED  ] " << (rolls ? "rolling discs: " : "resting boxes: ") << more
                  << " instructions a body and step more, of " << off / kBodies << '\n';
        EXPECT_GT(off, 100 * kBodies) << "the step was not counted";
        EXPECT_LE(more, kMostInstructions);
    }
}

}  // namespace
}  // namespace swept
