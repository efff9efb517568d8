#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include <swept/toi/toi_method.h>

#include "../../toi/toi_families.h"
#include "kernels.h"

namespace swept::bench {
namespace {

constexpr int kQueries = 1000;

void runMethod(benchmark::State& state, ToiMethod method) {
    std::vector<ToiQuery> queries;
    for (std::uint64_t i = 0; i < kQueries; ++i) { queries.push_back(makeToiCase(ToiFamily::generic, 1, i)); }
    for ([[maybe_unused]] auto _ : state) {
        for (const ToiQuery& q : queries) {
            benchmark::DoNotOptimize(timeOfImpactBy(method, q.a, q.sweepA, q.b, q.sweepB, q.settings));
        }
    }
    state.counters["per_query"] =
        benchmark::Counter(kQueries, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace

void registerToiKernels() {
    for (const ToiMethodInfo& info : kToiMethods) {
        benchmark::RegisterBenchmark(("toi/generic/" + std::string(info.name)).c_str(), runMethod, info.method);
    }
}

}  // namespace swept::bench
