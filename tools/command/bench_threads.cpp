#include "bench_threads.h"

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <swept/samples/scene_names.h>

#include "../bench/threads_bench.h"
#include "../task_threads.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct ThreadsArguments {
    bench::ThreadsBenchSettings settings;
    std::string profile;
    BenchPlaces places;
};

std::vector<std::string> threadsSceneNames() {
    std::vector<std::string> names;
    for (const bench::ThreadsScene& scene : bench::threadsScenes()) { names.emplace_back(scene.name); }
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
    if (bench::threadsRowCount(arguments.settings) == 0) {
        return refuse("bench threads: no world has as many bodies as --fewest and --most ask for");
    }
    std::vector<bench::ThreadsBenchRow> rows;
    return runBench(
        arguments.places,
        {.title = "bench threads: 1 against " + std::to_string(arguments.settings.threads) + ", " +
                  std::to_string(arguments.settings.steps) + " steps, " +
                  std::string(namesOf<SceneProfile>()[static_cast<std::size_t>(arguments.settings.profile)]),
         .measure =
             [&] {
                 Progress progress("bench", static_cast<std::int64_t>(bench::threadsRowCount(arguments.settings)));
                 std::int64_t done = 0;
                 rows = bench::benchThreads(arguments.settings,
                                            [&](const bench::ThreadsBenchRow&) { progress.update(++done); });
                 bench::writeThreadsTable(std::cout, rows);
             },
         .writeCsv = [&](std::ostream& csv) { bench::writeThreadsCsv(csv, rows, arguments.settings); },
         .writeOther = {},
         .plot = {}});
}

}  // namespace

void addBenchThreads(Command bench) {
    const Command command =
        bench.command("threads", "One thread against several, from 10 bodies on, with Box2D 3 beside it");
    const auto arguments = std::make_shared<ThreadsArguments>();
    command.option("--threads", arguments->settings.threads, "Threads, the calling one included [2]")
        .type("N")
        .within(2, kMostThreads);
    command.option("--scenes", arguments->settings.scenes, "Only these scenes, separated by commas")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(threadsSceneNames());
    command.option("--fewest", arguments->settings.fewestBodies, "Smallest number of bodies [10]")
        .type("N")
        .within(10, 1'000'000);
    command.option("--most", arguments->settings.mostBodies, "Largest number of bodies [10000]")
        .type("N")
        .within(10, 1'000'000);
    command.flag("--own", arguments->settings.ownAlone, "Without Box2D 3");
    command.option("--steps", arguments->settings.steps, "Steps of each row, after 20 that are not timed [400]")
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
