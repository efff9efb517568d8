#include "bench_world.h"

#include <iostream>
#include <memory>
#include <utility>

#include <swept/samples/scene_reader.h>

#include "../worlds/world_bench.h"
#include "../worlds/world_child.h"
#include "../worlds/world_table.h"
#include "../writers/output_files.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"
#include "world_names.h"

namespace swept {
namespace {

constexpr const char* kMedian = "median";
constexpr const char* kFastest = "fastest";

struct WorldArguments {
    worlds::WorldBenchSettings settings;
    std::string counts = kMedian;
    int maxBodies = 0;
    std::string scenesTo;  ///< a directory
    BenchPlaces places;
};

std::vector<std::string> sceneNames() { return namesOfScenes(worlds::allScenes()); }

std::vector<worlds::WorldRow> measureScenes(const worlds::WorldBenchSettings& settings) {
    const std::size_t contestants = settings.engines.empty() ? engineNames().size() : settings.engines.size();
    const std::size_t scenes = settings.scenes.empty() ? sceneNames().size() : settings.scenes.size();
    Progress progress("bench", static_cast<std::int64_t>(scenes * contestants));
    return worlds::benchWorlds(settings, [&](const std::vector<worlds::WorldRow>& rows) {
        progress.update(static_cast<std::int64_t>(rows.size()));
    });
}

/// A resting scene and a moving one, a hundred bodies to `maxBodies` in powers of ten.
std::vector<worlds::WorldRow> measureGrowth(const WorldArguments& arguments) {
    std::vector<worlds::WorldRow> rows;
    for (const char* const name : {"many-pyramids", "junkyard"}) {
        const worlds::SceneEntry& entry = *worlds::sceneNamed(name);
        const auto published = static_cast<double>(entry.make(1).scene.bodies.size());
        for (int bodies = 100; bodies <= arguments.maxBodies; bodies *= 10) {
            worlds::WorldBenchSettings settings = arguments.settings;
            settings.size = bodies / published;
            for (worlds::WorldRow& row : worlds::benchScene(entry, settings)) { rows.push_back(std::move(row)); }
        }
    }
    return rows;
}

/// The scenes as they begin, without what their scripts do: for `swept run` and other tools.
int writeScenes(const WorldArguments& arguments) {
    const worlds::WorldBenchSettings& settings = arguments.settings;
    OutputFiles files;
    files.addDirectory("--write", arguments.scenesTo);
    std::vector<std::pair<std::string, const worlds::SceneEntry*>> wanted;
    for (const std::string& name : settings.scenes.empty() ? sceneNames() : settings.scenes) {
        wanted.emplace_back(arguments.scenesTo + '/' + name + ".json", worlds::sceneNamed(name));
        files.addFile("--write", wanted.back().first);
    }
    std::string error;
    if (!files.open(error)) { return refuse(error); }
    for (const auto& [path, entry] : wanted) { *files.stream(path) << writeScene(entry->make(settings.size).scene); }
    if (!files.close(error)) { return refuse(error); }
    for (const auto& [path, entry] : wanted) { std::cout << "scene  " << path << '\n'; }
    return kExitDone;
}

int measureWorld(const WorldArguments& arguments) {
    if (!arguments.scenesTo.empty()) { return writeScenes(arguments); }
    std::vector<worlds::WorldRow> rows;
    std::vector<worlds::WorldRow> growth;
    const worlds::WorldBenchSettings& settings = arguments.settings;
    return runBench(
        arguments.places,
        {.title = "bench world: one thread, 60 Hz, each engine with its defaults and in a process of its own; in turns "
                  "of 20 steps, "
                  "of each step the " +
                  arguments.counts + " of " + std::to_string(settings.repeats),
         .measure =
             [&] {
                 if (arguments.maxBodies > 0) {
                     growth = measureGrowth(arguments);
                     worlds::writeGrowthTable(std::cout, growth);
                 } else {
                     rows = measureScenes(settings);
                     worlds::writeWorldTables(std::cout, rows);
                 }
             },
         .writeCsv = [&](std::ostream& csv) { worlds::writeWorldCsv(csv, arguments.maxBodies > 0 ? growth : rows); },
         .writeOther = {},
         .plot = [&](const std::string& directory,
                     std::string& error) { return worlds::plotWorlds(directory, rows, growth, error); }});
}

}  // namespace

void addBenchWorld(Command bench) {
    const Command command = bench.command("world", "Large scenes in every engine: time, stages, memory, outcome");
    const auto arguments = std::make_shared<WorldArguments>();
    worlds::WorldBenchSettings& settings = arguments->settings;
    const Option scenes = command.option("--scenes", settings.scenes, "Only these scenes, separated by commas")
                              .type("NAME,...")
                              .separatedBy(',')
                              .oneOf(sceneNames());
    command.option("--engines", settings.engines, "Only these engines, separated by commas")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(engineNames());
    const Option steps =
        command.option("--steps", settings.steps, "Steps that are timed, once a scene is what it is about [60]")
            .type("N")
            .within(1, 100'000);
    const Option full =
        command.flag("--full", settings.full, "Instead: from the first step, as many as the published benchmark has")
            .excludes(steps);
    const Option size = command.option("--size", settings.size, "Of the number of moving bodies, 1 as published [0.25]")
                            .type("X")
                            .withinReals(1e-4, 100);
    command.option("--repeats", settings.repeats, "Runs of each [3]").type("N").within(1, 100);
    command.option("--of", arguments->counts, "Which of the runs counts, for each step [median]")
        .type("median|fastest")
        .oneOf({kMedian, kFastest});
    command.option("--seconds", settings.seconds, "Processor time after which an engine is stopped in a scene [5]")
        .type("S")
        .withinReals(0, 100'000);
    const Option growth =
        command.option("--growth", arguments->maxBodies, "Instead: cost of a body in worlds of a hundred to N bodies")
            .type("N")
            .within(100, 1'000'000)
            .excludes(scenes)
            .excludes(size);
    const Option csv =
        command.option("--csv", arguments->places.csv, "Write a record for each engine and scene").type("FILE");
    const Option plots = command
                             .option("--plots", arguments->places.plots,
                                     "Write data and gnuplot scripts, and draw them if gnuplot is there")
                             .type("DIR");
    command.option("--write", arguments->scenesTo, "Instead: write the scenes as they begin, for other tools")
        .type("DIR")
        .excludes(growth)
        .excludes(steps)
        .excludes(full)
        .excludes(csv)
        .excludes(plots);
    command.runs([arguments] {
        arguments->settings.counts = arguments->counts == kFastest ? worlds::Repeats::fastest : worlds::Repeats::median;
        return measureWorld(*arguments);
    });
}

void addWorldChildCommand(Command app) {
    const Command command = app.command(worlds::kWorldChildCommand, "");
    command.runs([] { return worlds::runWorldChild(); });
}

}  // namespace swept
