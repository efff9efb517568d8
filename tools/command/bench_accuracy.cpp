#include "bench_accuracy.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <memory>

#include "../accuracy/accuracy_bench.h"
#include "../accuracy/accuracy_plot.h"
#include "../accuracy/accuracy_table.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct AccuracyArguments {
    std::vector<std::string> scenes;
    bool isLong = false;
    bool trade = false;
    BenchPlaces places;
};

/// Steps a second and sub-steps of a step, as the trade is measured.
struct Effort {
    double hertz;
    int subSteps;
};
constexpr std::array<Effort, 10> kEfforts{
    {{30, 8}, {30, 16}, {30, 32}, {60, 4}, {60, 8}, {60, 16}, {60, 32}, {60, 64}, {120, 16}, {240, 16}}};

/// Of all and of a group the long ones only on request; a scene that is named is wanted.
bool isWanted(const accuracy::Case& c, const AccuracyArguments& arguments) {
    const bool isUsual = arguments.isLong || !c.isLong;
    if (arguments.scenes.empty()) { return isUsual; }
    return std::any_of(arguments.scenes.begin(), arguments.scenes.end(),
                       [&](const std::string& name) { return name == c.name || (name == c.group && isUsual); });
}

/// Every case that the arguments ask for, at every effort.
std::vector<accuracy::Case> casesOf(const AccuracyArguments& arguments) {
    std::vector<accuracy::Case> cases;
    for (const accuracy::Case& c : arguments.trade ? accuracy::tradeCases() : accuracy::allCases()) {
        if (!isWanted(c, arguments)) { continue; }
        if (!arguments.trade) {
            cases.push_back(c);
            continue;
        }
        for (const Effort& effort : kEfforts) { cases.push_back(accuracy::refined(c, effort.hertz, effort.subSteps)); }
    }
    return cases;
}

std::vector<accuracy::Row> measureAll(const std::vector<accuracy::Case>& cases) {
    const std::vector<accuracy::Contestant> contestants = accuracy::allContestants();
    Progress progress("bench", static_cast<std::int64_t>(cases.size() * contestants.size()));
    std::vector<accuracy::Row> rows;
    for (const accuracy::Case& c : cases) {
        for (const accuracy::Contestant& contestant : contestants) {
            rows.push_back(accuracy::measure(c, contestant));
            progress.update(static_cast<std::int64_t>(rows.size()));
        }
    }
    return rows;
}

int measureAccuracy(const AccuracyArguments& arguments) {
    std::vector<accuracy::Row> rows;
    return runBench(arguments.places,
                    {.title = "bench accuracy: g = 10 m/s^2, 60 Hz unless said, no sleep, density 1",
                     .measure =
                         [&] {
                             rows = measureAll(casesOf(arguments));
                             (arguments.trade ? accuracy::writeTradeTables : accuracy::writeTables)(std::cout, rows);
                         },
                     .writeCsv = [&](std::ostream& csv) { accuracy::writeCsv(csv, rows); },
                     .writeOther = {},
                     .plot = [&](const std::string& directory,
                                 std::string& error) { return accuracy::plotTrade(directory, rows, error); }});
}

std::vector<std::string> knownNames() {
    std::vector<std::string> names;
    for (const accuracy::Case& c : accuracy::allCases()) {
        if (std::find(names.begin(), names.end(), c.group) == names.end()) { names.push_back(c.group); }
        names.push_back(c.name);
    }
    return names;
}

}  // namespace

void addBenchAccuracy(Command bench) {
    const Command command = bench.command("accuracy", "Scenes whose outcome is known: how far each engine is from it");
    const auto arguments = std::make_shared<AccuracyArguments>();
    command.option("--scenes", arguments->scenes, "Only these scenes or groups, separated by commas")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(knownNames);
    command.flag("--long", arguments->isLong,
                 "Also the long scenes of all or of a group: stack-200, -500, -1000, pyramid-50, drop-97.0");
    const Option trade =
        command.flag("--trade", arguments->trade, "Error against cost, over steps and sub-steps, for seven scenes");
    command.option("--csv", arguments->places.csv, "Write a record for each number").type("FILE");
    command.option("--plots", arguments->places.plots, "Draw error against cost (with --trade), if gnuplot is there")
        .type("DIR")
        .needs(trade);
    command.runs([arguments] { return measureAccuracy(*arguments); });
}

}  // namespace swept
