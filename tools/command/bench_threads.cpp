#include "bench_threads.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <swept/samples/scene_names.h>

#include "../task_threads.h"
#include "../worlds/threads_bench.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct ThreadsArguments {
    worlds::ThreadsBenchSettings settings;
    std::string profile;
    BenchPlaces places;
};

std::vector<std::string> threadsSceneNames() {
    std::vector<std::string> names;
    for (const worlds::GrowingScene& scene : worlds::growingScenes()) { names.emplace_back(scene.name); }
    for (const worlds::SceneEntry& scene : worlds::allScenes()) { names.emplace_back(scene.name); }
    return names;
}

std::vector<std::string> profileNames() {
    const auto names = namesOf<SceneProfile>();
    return {names.begin(), names.end()};
}

int measureThreads(const ThreadsArguments& arguments) {
    if (makeTaskSystem(arguments.settings.threads) == nullptr) {
        return refuse("bench threads: built without oneTBB, so there is only one thread");
    }
    if (worlds::threadsRowCount(arguments.settings) == 0) {
        return refuse("bench threads: no world has as many bodies as --fewest and --most ask for");
    }
    std::vector<worlds::ThreadsBenchRow> rows;
    return runBench(
        arguments.places,
        {.title = "bench threads: 1 against " + std::to_string(arguments.settings.threads) + ", " +
                  std::to_string(arguments.settings.steps) + " steps, " +
                  std::string(namesOf<SceneProfile>()[static_cast<std::size_t>(arguments.settings.profile)]),
         .measure =
             [&] {
                 Progress progress("bench", static_cast<std::int64_t>(worlds::threadsRowCount(arguments.settings)));
                 std::int64_t done = 0;
                 rows = worlds::benchThreads(arguments.settings,
                                             [&](const worlds::ThreadsBenchRow&) { progress.update(++done); });
                 worlds::writeThreadsTable(std::cout, rows);
             },
         .writeCsv = [&](std::ostream& csv) { worlds::writeThreadsCsv(csv, rows, arguments.settings); },
         .writeOther = {},
         .plot = {}});
}

}  // namespace

void addBenchThreads(Command bench) {
    const Command command = bench.command(
        "threads", "One thread against several, from 10 bodies on and in large scenes, with Box2D 3 beside it");
    const auto arguments = std::make_shared<ThreadsArguments>();
    command.option("--threads", arguments->settings.threads, "Threads, the calling one included [2]")
        .type("N")
        .within(2, kMostThreads);
    command
        .option("--scenes", arguments->settings.scenes,
                "Only these scenes, separated by commas [the first three, and the ten of Box2D 3]")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(threadsSceneNames());
    command
        .option("--fewest", arguments->settings.fewestBodies,
                "Smallest number of bodies in the first three scenes [10]")
        .type("N")
        .within(10, 1'000'000);
    command
        .option("--most", arguments->settings.mostBodies, "Largest number of bodies in the first three scenes [10000]")
        .type("N")
        .within(10, 1'000'000);
    command
        .option("--size", arguments->settings.size,
                "Of the number of moving bodies in the others, 1 as published [0.25]")
        .type("X")
        .withinReals(1e-4, 100);
    command.flag("--own", arguments->settings.ownAlone, "Without Box2D 3");
    command.option("--steps", arguments->settings.steps, "Steps of each row, once the scene is what it is about [400]")
        .type("N")
        .within(10, 1'000'000);
    command.option("--profile", arguments->profile, "How worlds of ours solve [accurate]")
        .type("NAME")
        .oneOf(profileNames());
    command.option("--csv", arguments->places.csv, "Write the table").type("FILE");
    command.runs([arguments] {
        const std::vector<std::string> names = profileNames();
        const auto named = std::find(names.begin(), names.end(), arguments->profile);
        if (named != names.end()) { arguments->settings.profile = static_cast<SceneProfile>(named - names.begin()); }
        return measureThreads(*arguments);
    });
}

}  // namespace swept
