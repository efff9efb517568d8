#include "bench_joints.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../worlds/joint_scenes.h"
#include "../worlds/world_bench.h"
#include "../worlds/world_table.h"
#include "bench_run.h"
#include "progress.h"
#include "world_names.h"

namespace swept {
namespace {

struct JointsArguments {
    worlds::WorldBenchSettings settings;
    BenchPlaces places;
};

std::vector<std::string> jointNames() { return namesOfScenes(worlds::jointScenes()); }

/// Those that are there of what is compared unless others are asked for.
std::vector<std::string> usualEngines() {
    std::vector<std::string> names = engineNames();
    std::erase_if(names, [](const std::string& name) {
        return name != "fast f32" && name != "accurate f32" && name != worlds::kRival && name != "Box2D 2.4.1";
    });
    return names;
}

std::vector<worlds::WorldRow> measuredRows(const worlds::WorldBenchSettings& settings) {
    Progress progress("bench", static_cast<std::int64_t>(settings.scenes.size()));
    std::vector<worlds::WorldRow> rows;
    std::int64_t done = 0;
    for (const worlds::SceneEntry& entry : worlds::jointScenes()) {
        if (std::find(settings.scenes.begin(), settings.scenes.end(), entry.name) == settings.scenes.end()) {
            continue;
        }
        for (worlds::WorldRow& row : worlds::benchScene(entry, settings)) { rows.push_back(std::move(row)); }
        progress.update(++done);
    }
    return rows;
}

int measureJoints(const JointsArguments& arguments) {
    worlds::WorldBenchSettings settings = arguments.settings;
    if (settings.scenes.empty()) { settings.scenes = jointNames(); }
    if (settings.engines.empty()) { settings.engines = usualEngines(); }
    std::vector<worlds::WorldRow> rows;
    return runBench(arguments.places,
                    {.title = "bench joints: one thread, 60 Hz, each engine with its defaults and in a process of its "
                              "own; in turns of 20 steps, of each step the median of " +
                              std::to_string(settings.repeats),
                     .measure =
                         [&] {
                             rows = measuredRows(settings);
                             worlds::writeJointTables(std::cout, rows);
                         },
                     .writeCsv = [&](std::ostream& csv) { worlds::writeWorldCsv(csv, rows); },
                     .writeOther = {},
                     .plot = {}});
}

}  // namespace

void addBenchJoints(Command bench) {
    const Command command = bench.command("joints", "What each sort of joint costs, in every engine");
    const auto arguments = std::make_shared<JointsArguments>();
    worlds::WorldBenchSettings& settings = arguments->settings;
    settings.size = 1;
    command.option("--joints", settings.scenes, "Only these sorts, separated by commas")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(jointNames());
    command
        .option("--engines", settings.engines,
                "These engines, separated by commas [fast f32,accurate f32 and both Box2D]")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(engineNames());
    command.option("--steps", settings.steps, "Steps that are timed, after 20 [60]").type("N").within(1, 100'000);
    command.option("--size", settings.size, "Of the hundred machines of each sort [1]")
        .type("X")
        .withinReals(1e-4, 100);
    command.option("--repeats", settings.repeats, "Runs of each [3]").type("N").within(1, 100);
    command.option("--csv", arguments->places.csv, "Write a record for each engine and sort").type("FILE");
    command.runs([arguments] { return measureJoints(*arguments); });
}

}  // namespace swept
