#include "bench_effort.h"

#include <iostream>
#include <memory>

#include "../bench/effort_bench.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct EffortArguments {
    bench::EffortBenchSettings settings;
    BenchPlaces places;
};

int measureEffort(const EffortArguments& arguments) {
    std::vector<bench::EffortRow> rows;
    return runBench(
        arguments.places,
        {.title = "bench effort: error budgets against the smallest fixed number of sub-steps that keeps them",
         .measure =
             [&] {
                 Progress progress("bench", 2 * static_cast<std::int64_t>(bench::effortScenes().size()));
                 std::int64_t done = 0;
                 rows =
                     bench::benchEffort(arguments.settings, [&](const bench::EffortRow&) { progress.update(++done); });
                 bench::writeEffortTable(std::cout, rows);
             },
         .writeCsv = [&](std::ostream& csv) { bench::writeEffortCsv(csv, rows); },
         .writeOther = {},
         .plot = {}});
}

}  // namespace

void addBenchEffort(Command bench) {
    const Command command = bench.command(
        "effort",
        "Error budgets against fixed sub-steps, in scenes that are demanding for a short time or in one place");
    const auto arguments = std::make_shared<EffortArguments>();
    command.option("--budget", arguments->settings.budget, "Budgets, times those of the scenes [1]")
        .type("FACTOR")
        .withinReals(1e-3, 1e3);
    command.option("--repeats", arguments->settings.repeats, "Runs of each that are timed [3]")
        .type("N")
        .within(1, 1000);
    command.option("--csv", arguments->places.csv, "Write the table").type("FILE");
    command.runs([arguments] { return measureEffort(*arguments); });
}

}  // namespace swept
