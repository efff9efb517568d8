#include <benchmark/benchmark.h>

#include <iostream>
#include <vector>

#include "../machine.h"
#include "distance_contestant.h"
#include "kernels.h"
#include "ratio_reporter.h"

/// Times of the kernels, one query each. Distances of both precisions and of other engines on the same pairs:
///   swept_bench_kernels --benchmark_filter=distance --benchmark_repetitions=15
///       --benchmark_enable_random_interleaving --benchmark_report_aggregates_only --benchmark_min_time=0.02
/// gives medians of runs in turns, and ratios of these.

namespace swept::bench {
namespace {

constexpr int kPairs = 2000;

void timePasses(benchmark::State& state, DistanceContestant& contestant, std::span<const PairCase> pairs, bool isWarm) {
    contestant.load(pairs);
    contestant.warmPass();
    for ([[maybe_unused]] auto _ : state) {
        benchmark::DoNotOptimize(isWarm ? contestant.warmPass() : contestant.coldPass());
    }
    state.counters["per_query"] = benchmark::Counter(
        static_cast<double>(pairs.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

using Contestants = std::vector<std::unique_ptr<DistanceContestant>>;

Contestants makeContestants() {
    Contestants contestants;
    contestants.push_back(makeDistanceF32());
    contestants.push_back(makeDistanceF64());
    contestants.push_back(makeDistanceBox2d());
#if defined(SWEPT_BENCH_BOX2D3)
    contestants.push_back(makeDistanceBox2d3());
#endif
    return contestants;
}

/// @return whether all contestants give the same sum of distances, so that their times may be compared.
bool registerDistances(const Contestants& contestants, std::vector<std::vector<PairCase>>& allPairs) {
    bool agree = true;
    for (std::size_t k = 0; k < kPairKinds.size(); ++k) {
        const std::vector<PairCase>& pairs = allPairs.emplace_back(makePairs(kPairKinds[k], kPairs));
        double first = 0;
        for (const auto& contestant : contestants) {
            contestant->load(pairs);
            const double sum = contestant->coldPass();
            first = first == 0 ? sum : first;
            if (!(std::abs(sum - first) < 1e-3 * first)) {
                std::cerr << contestant->name() << " does not answer the same on " << nameOf(kPairKinds[k]) << '\n';
                agree = false;
            }
            for (const bool isWarm : {false, true}) {
                const std::string name = std::string("distance/") + (isWarm ? "warm/" : "cold/") +
                                         std::string(nameOf(kPairKinds[k])) + '/' + contestant->name();
                benchmark::RegisterBenchmark(
                    name.c_str(), [&contestant = *contestant, &allPairs, k, isWarm](benchmark::State& state) {
                        timePasses(state, contestant, allPairs[k], isWarm);
                    });
            }
        }
    }
    return agree;
}

int run(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) { return 2; }
    const Contestants contestants = makeContestants();
    std::vector<std::vector<PairCase>> pairs;
    if (!registerDistances(contestants, pairs)) { return 1; }
    registerShapeKernelsF32();
    registerShapeKernelsF64();
    registerSolverKernelsF32();
    registerSolverKernelsF64();
    registerFlightKernelsF32();
    registerFlightKernelsF64();
#if defined(SWEPT_BENCH_CHIPMUNK)
    registerFlightChipmunk();
#endif
    registerEditKernelsF32();
    registerEditKernelsF64();
    registerEditBox2d();
    registerToiKernels();
    std::cout << machineText() << '\n';
    RatioReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    reporter.printRatios(std::cout);
    return 0;
}

}  // namespace
}  // namespace swept::bench

int main(int argc, char** argv) { return swept::bench::run(argc, argv); }
