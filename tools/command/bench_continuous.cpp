#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "../bench/continuous_bench.h"
#include "../bench/crowd_bench.h"
#include "../bench/machine.h"
#include "../output_files.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct ContinuousArguments {
    bench::ContinuousBenchSettings settings;
    std::string csv;
    std::string plots;
    bool crowds = false;
};

std::vector<bench::CrowdRow> measureCrowds(const ContinuousArguments& arguments) {
    if (!arguments.crowds) { return {}; }
    std::vector<bench::CrowdRow> crowds;
    {
        Progress progress("crowds", bench::kCrowdCount);
        crowds = bench::benchCrowds(arguments.settings, [&](int done) { progress.update(done); });
    }
    std::cout << '\n';
    bench::writeCrowdTable(std::cout, crowds);
    return crowds;
}

int measure(const ContinuousArguments& arguments) {
    OutputFiles files;
    files.addFile("--csv", arguments.csv);
    if (!arguments.plots.empty()) {
        files.addDirectory("--plots", arguments.plots);
    }
    std::string error;
    if (!files.open(error)) {
        return refuse(error);
    }
    std::cout << bench::machineText() << "\nbench continuous: f32, 60 Hz, accurate, " << arguments.settings.shots
              << " shots a shape and speed, seed " << arguments.settings.seed << "\n\n"
              << std::flush;
    std::vector<bench::ModeRow> modes;
    std::vector<bench::ThicknessRow> walls;
    {
        Progress progress("bench continuous", 9);
        modes = bench::benchModes(arguments.settings, [&](int done) { progress.update(done); });
        walls = bench::benchThickness(arguments.settings, [&](int done) { progress.update(5 + done); });
    }
    bench::writeModeTable(std::cout, modes);
    std::cout << '\n';
    bench::writeThicknessTable(std::cout, walls);
    const std::vector<bench::CrowdRow> crowds = measureCrowds(arguments);
    if (std::ostream* const csv = files.stream(arguments.csv)) {
        bench::writeContinuousCsv(*csv, modes, walls);
        bench::writeCrowdCsv(*csv, crowds);
    }
    if (!files.close(error)) {
        return refuse(error);
    }
    if (!arguments.plots.empty()) {
        const std::string told = bench::plotThickness(arguments.plots, walls, error);
        if (!error.empty()) {
            return refuse(error);
        }
        std::cout << '\n' << told << '\n';
    }
    return kExitDone;
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
    command.option("--csv", arguments->csv, "Write the tables, a record for each number").type("FILE");
    command.option("--plots", arguments->plots, "Draw how thick a wall must be, if gnuplot is there").type("DIR");
    command.runs([arguments] { return measure(*arguments); });
}

}  // namespace swept
