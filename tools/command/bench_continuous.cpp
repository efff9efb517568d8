#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "../bench/continuous_bench.h"
#include "../bench/crowd_bench.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct ContinuousArguments {
    bench::ContinuousBenchSettings settings;
    BenchPlaces places;
    bool crowds = false;
};

struct ContinuousResults {
    std::vector<bench::ModeRow> modes;
    std::vector<bench::ThicknessRow> walls;
    std::vector<bench::CrowdRow> crowds;
};

ContinuousResults measureAll(const ContinuousArguments& arguments) {
    ContinuousResults results;
    {
        Progress progress("bench continuous", 9);
        results.modes = bench::benchModes(arguments.settings, [&](int done) { progress.update(done); });
        results.walls = bench::benchThickness(arguments.settings, [&](int done) { progress.update(5 + done); });
    }
    if (arguments.crowds) {
        Progress progress("crowds", bench::kCrowdCount);
        results.crowds = bench::benchCrowds(arguments.settings, [&](int done) { progress.update(done); });
    }
    return results;
}

int measure(const ContinuousArguments& arguments) {
    ContinuousResults results;
    return runBench(
        arguments.places,
        {.title = "bench continuous: f32, 60 Hz, accurate, " + std::to_string(arguments.settings.shots) +
                  " shots a shape and speed, seed " + std::to_string(arguments.settings.seed) + '\n',
         .measure =
             [&] {
                 results = measureAll(arguments);
                 bench::writeModeTable(std::cout, results.modes);
                 std::cout << '\n';
                 bench::writeThicknessTable(std::cout, results.walls);
                 if (!arguments.crowds) { return; }
                 std::cout << '\n';
                 bench::writeCrowdTable(std::cout, results.crowds);
             },
         .writeCsv =
             [&](std::ostream& csv) {
                 bench::writeContinuousCsv(csv, results.modes, results.walls);
                 bench::writeCrowdCsv(csv, results.crowds);
             },
         .writeOther = {},
         .plot = [&](const std::string& directory,
                     std::string& error) { return bench::plotThickness(directory, results.walls, error); }});
}

}  // namespace

void addContinuousBench(Command bench) {
    const Command command =
        bench.command("continuous", "Every continuous mode: what it misses, makes up, loses and costs");
    const auto arguments = std::make_shared<ContinuousArguments>();
    command.option("--count", arguments->settings.shots, "Shots a shape and speed [100]").type("N").within(1, 2000);
    command.option("--seed", arguments->settings.seed, "The same seed gives the same shots [1]")
        .type("S")
        .within(std::int64_t{0}, std::numeric_limits<std::int64_t>::max());
    command.flag("--crowds", arguments->crowds, "Also what crowds of 1000 cost, beside other engines");
    command.option("--csv", arguments->places.csv, "Write the tables, a record for each number").type("FILE");
    command.option("--plots", arguments->places.plots, "Draw how thick a wall must be, if gnuplot is there")
        .type("DIR");
    command.runs([arguments] { return measure(*arguments); });
}

}  // namespace swept
