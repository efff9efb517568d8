#include "bench_broadphase.h"

#include <algorithm>
#include <iostream>
#include <limits>
#include <memory>

#include "../bench/broadphase_bench.h"
#include "../bench/broadphase_bench_plots.h"
#include "../bench/broadphase_bench_table.h"
#include "../bench/broadphase_margin.h"
#include "../bench/broadphase_peer_scenes.h"
#include "../bench/broadphase_roofline.h"
#include "../bench/overlap_bench.h"
#include "bench_run.h"
#include "commands.h"
#include "progress.h"

namespace swept {
namespace {

struct BroadphaseArguments {
    bench::BroadphaseBenchSettings settings;
    std::uint32_t maxCount = 10'000;
    std::uint32_t count = 0;
    BenchPlaces places;
    std::string marginCsv;
};

struct OverlapArguments {
    bench::OverlapBenchSettings settings;
    BenchPlaces places;
};

/// Everything that was measured.
struct BroadphaseResults {
    std::vector<bench::BroadphaseRow> distributions;
    std::vector<bench::BroadphaseRow> peers;
    std::vector<bench::MarginRow> margins;
};

/// Powers of ten from a hundred on, or just one size.
std::vector<std::uint32_t> countsOf(const BroadphaseArguments& arguments) {
    if (arguments.count > 0) { return {arguments.count}; }
    std::vector<std::uint32_t> counts;
    for (std::uint32_t count = 100; count <= arguments.maxCount; count *= 10) { counts.push_back(count); }
    return counts;
}

std::vector<std::string> boxSceneNames() {
    std::vector<std::string> names;
    for (const bench::BoxScene scene : bench::kBoxScenes) { names.emplace_back(bench::nameOf(scene)); }
    for (const bench::PeerScene scene : bench::kPeerScenes) { names.emplace_back(bench::nameOf(scene)); }
    names.emplace_back("margins");
    return names;
}

BroadphaseResults measureAll(const bench::BroadphaseBenchSettings& settings) {
    BroadphaseResults results;
    const auto steps = std::size(bench::kBoxScenes) * settings.counts.size() + std::size(bench::kPeerScenes) + 3;
    Progress progress("bench", static_cast<std::int64_t>(steps));
    std::int64_t done = 0;
    const auto update = [&](const std::string&) { progress.update(done++); };
    results.distributions = bench::benchDistributions(settings, update);
    results.peers = bench::benchPeerScenes(settings, update);
    if (bench::isWanted("margins", settings.scenes)) { results.margins = bench::benchMargins(settings, update); }
    return results;
}

void writeAll(const BroadphaseResults& results) {
    bench::writeDistributionTables(std::cout, results.distributions);
    bench::writePeerTables(std::cout, results.peers);
    if (!results.distributions.empty()) {
        std::cout << "\nDistributions, hand over and pairs";
        bench::writeRivalry(std::cout, results.distributions);
    }
    if (!results.peers.empty()) {
        std::cout << "\nScenes, hand over and pairs";
        bench::writeRivalry(std::cout, results.peers);
        const bench::MachineLimits limits = bench::measureLimits();
        std::vector<bench::BroadphaseRow> chosen;
        std::copy_if(results.peers.begin(), results.peers.end(), std::back_inserter(chosen),
                     [](const auto& row) { return row.method == bench::kDefaultBroadphase; });
        bench::writeRoofline(std::cout, bench::rooflineOf(chosen, limits), limits);
    }
    if (!results.margins.empty()) { bench::writeMarginTable(std::cout, results.margins); }
    std::cout << std::flush;
}

int measureBroadphase(BroadphaseArguments& arguments) {
    arguments.settings.counts = countsOf(arguments);
    BroadphaseResults results;
    BenchPlaces places = arguments.places;
    places.others = {{"--margin-csv", arguments.marginCsv}};
    return runBench(
        places,
        {.title = "bench broadphase: float, one thread, seed " + std::to_string(arguments.settings.seed) +
                  "; the fastest of several passes in turns, step by step",
         .measure =
             [&] {
                 results = measureAll(arguments.settings);
                 writeAll(results);
             },
         .writeCsv =
             [&](std::ostream& csv) {
                 std::vector<bench::BroadphaseRow> rows = results.distributions;
                 rows.insert(rows.end(), results.peers.begin(), results.peers.end());
                 bench::writeBroadphaseCsv(csv, rows);
             },
         .writeOther = [&](const std::string&, std::ostream& csv) { bench::writeMarginCsv(csv, results.margins); },
         .plot =
             [&](const std::string& directory, std::string& error) {
                 return bench::plotBroadphase(directory, results.distributions, results.peers, results.margins, error);
             }});
}

int measureOverlap(const OverlapArguments& arguments) {
    std::vector<bench::OverlapRow> rows;
    return runBench(
        arguments.places,
        {.title = "bench overlap: float, " + std::to_string(arguments.settings.count) + " pairs a family, seed " +
                  std::to_string(arguments.settings.seed) + "; the fastest of several passes in turns",
         .measure =
             [&] {
                 rows = bench::benchOverlap(arguments.settings);
                 bench::writeOverlapTable(std::cout, rows);
             },
         .writeCsv = [&](std::ostream& csv) { bench::writeOverlapCsv(csv, rows, arguments.settings); },
         .writeOther = {},
         .plot = [&](const std::string& directory,
                     std::string& error) { return bench::plotOverlap(directory, rows, error); }});
}

constexpr std::int64_t kMostSeed = std::numeric_limits<std::int64_t>::max();

void addBroadphaseOptions(Command app, BroadphaseArguments& arguments) {
    constexpr std::uint32_t kMost = 1'000'000;
    const Option most =
        app.option("--max-count", arguments.maxCount, "Most proxies of the distributions, in powers of ten [10000]")
            .type("N")
            .within(100U, kMost);
    app.option("--count", arguments.count, "Instead: so many and no others")
        .type("N")
        .within(10U, kMost)
        .excludes(most);
    app.option("--kinds", arguments.settings.kinds, "Only these implementations, separated by commas")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(bench::broadphaseNames());
    app.option("--scenes", arguments.settings.scenes, "Only these scenes; `margins` is one too")
        .type("NAME,...")
        .separatedBy(',')
        .oneOf(boxSceneNames());
    app.option("--seed", arguments.settings.seed, "The same seed gives the same boxes [1]")
        .type("S")
        .within(std::int64_t{0}, kMostSeed);
    app.option("--seconds", arguments.settings.secondsPerCase, "For each implementation on each case [0.05]")
        .type("S")
        .withinReals(0.0, 60.0);
    app.option("--csv", arguments.places.csv, "Write a record for each implementation, scene and size").type("FILE");
    app.option("--margin-csv", arguments.marginCsv, "Write a record for each margin").type("FILE");
    app.option("--plots", arguments.places.plots, "Write data and gnuplot scripts, and draw them if gnuplot is there")
        .type("DIR");
}

void addOverlapOptions(Command app, OverlapArguments& arguments) {
    app.option("--count", arguments.settings.count, "Pairs a family [2000]").type("N").within(1, 1'000'000);
    app.option("--seed", arguments.settings.seed, "The same seed gives the same pairs [1]")
        .type("S")
        .within(std::int64_t{0}, kMostSeed);
    app.option("--csv", arguments.places.csv, "Write a record for each volume and family").type("FILE");
    app.option("--plots", arguments.places.plots, "Write data and gnuplot script, and draw it if gnuplot is there")
        .type("DIR");
}

}  // namespace

void addBenchBroadphase(Command bench) {
    const Command broadphase = bench.command("broadphase", "Every way of finding pairs, on every kind of scene");
    const auto arguments = std::make_shared<BroadphaseArguments>();
    addBroadphaseOptions(broadphase, *arguments);
    broadphase.runs([arguments] { return measureBroadphase(*arguments); });
    const Command overlap = bench.command("overlap", "Bounding volumes: what they cost, what they let through");
    const auto ladder = std::make_shared<OverlapArguments>();
    addOverlapOptions(overlap, *ladder);
    overlap.runs([ladder] { return measureOverlap(*ladder); });
}

}  // namespace swept
