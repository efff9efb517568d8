#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>
#include <string>

#include "../bench/machine.h"
#include "../bench/toi_bench.h"
#include "../bench/toi_bench_plots.h"
#include "../bench/toi_bench_table.h"
#include "../bench/toi_certify.h"
#include "bench_accuracy.h"
#include "bench_broadphase.h"
#include "bench_effort.h"
#include "bench_joints.h"
#include "bench_run.h"
#include "bench_threads.h"
#include "bench_world.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct BenchArguments {
    bench::ToiBenchSettings settings;
    BenchPlaces places;
    std::int64_t certify = 0;
};

std::string settingsText(const std::string& what, std::int64_t count, const std::string& of, std::uint64_t seed) {
    return what + ": " + std::to_string(count) + of + ", seed " + std::to_string(seed);
}

int certify(const BenchArguments& arguments) {
    const std::uint64_t seed = arguments.settings.seed;
    std::cout << bench::machineText() << '\n'
              << settingsText("certify", arguments.certify, " queries of all families in turn", seed) << '\n'
              << std::flush;
    bench::CertifyResult result;
    {
        Progress progress("certify", arguments.certify);
        const auto update = [&progress](std::int64_t done) { progress.update(done); };
        const auto answerer = [](const ToiQuery& q) { return timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings); };
        result = bench::certifyToi(answerer, arguments.certify, seed, update);
    }
    for (int i = 0; i < static_cast<int>(result.counts.size()); ++i) {
        const auto verdict = static_cast<ToiVerdict>(i);
        std::cout << nameOf(verdict) << ": " << result.countOf(verdict) << '\n';
    }
    for (const bench::CertifyViolation& violation : result.violations) {
        std::cout << "violation: " << nameOf(violation.family) << '-' << seed << '-' << violation.index << ' '
                  << nameOf(violation.verdict) << '\n';
    }
    return result.wrong() == 0 ? kExitDone : kExitNotFinite;
}

int measure(const BenchArguments& arguments) {
    const bench::ToiContestants contestants = bench::allToiContestants();
    std::vector<bench::ToiBenchRow> rows;
    return runBench(
        arguments.places,
        {.title = settingsText("bench toi", arguments.settings.count, " queries a family", arguments.settings.seed),
         .measure =
             [&] {
                 Progress progress("bench", static_cast<std::int64_t>(contestants.size() * kToiFamilies.size()));
                 rows = bench::benchToi(contestants, arguments.settings, [&](int done, int) { progress.update(done); });
                 bench::writeToiTable(std::cout, rows);
             },
         .writeCsv = [&](std::ostream& csv) { bench::writeToiCsv(csv, rows, arguments.settings); },
         .writeOther = {},
         .plot =
             [&](const std::string& directory, std::string& error) {
                 Progress progress("turns", static_cast<std::int64_t>(contestants.size()) * 10);
                 const auto turns =
                     bench::benchTurns(contestants, arguments.settings, [&](int done, int) { progress.update(done); });
                 return bench::plotToiBench(directory, rows, turns, error);
             }});
}

void addToiOptions(Command toi, BenchArguments& arguments) {
    const Option count =
        toi.option("--count", arguments.settings.count, "Queries a family [2000]").type("N").within(1, 10'000'000);
    toi.option("--seed", arguments.settings.seed, "The same seed gives the same queries [1]")
        .type("S")
        .within(std::int64_t{0}, std::numeric_limits<std::int64_t>::max());
    const Option csv =
        toi.option("--csv", arguments.places.csv, "Write the table, a record for each method and family").type("FILE");
    const Option plots = toi.option("--plots", arguments.places.plots,
                                    "Write data and gnuplot scripts, and draw them if gnuplot is there")
                             .type("DIR");
    toi.option("--certify", arguments.certify,
               "Instead: have N answers of the default method judged; exit code 1 if one of them is wrong")
        .type("N")
        .within(std::int64_t{1}, std::numeric_limits<std::int64_t>::max())
        .excludes(count)
        .excludes(csv)
        .excludes(plots);
}

}  // namespace

void addBenchCommand(Command app) {
    const Command all = app.command("bench", "Measure what is claimed");
    all.needsCommand();
    const Command toi = all.command("toi", "Every time-of-impact method on every family of queries");
    addContinuousBench(all);
    const auto arguments = std::make_shared<BenchArguments>();
    addToiOptions(toi, *arguments);
    toi.runs([arguments] { return arguments->certify > 0 ? certify(*arguments) : measure(*arguments); });
    addBenchBroadphase(all);
    addBenchAccuracy(all);
    addBenchEffort(all);
    addBenchThreads(all);
    addBenchJoints(all);
    addBenchWorld(all);
}

}  // namespace swept
