#include "run_time.h"

#include <algorithm>

#include "stopwatch.h"

namespace swept::bench {
namespace {

constexpr int kTimedRuns = 3;
/// Seconds after which no further run is timed.
constexpr double kTimedSeconds = 4;

double timeOf(Runner& runner, std::int64_t steps) {
    const Stopwatch watch;
    for (std::int64_t i = 0; i < steps; ++i) { runner.step(); }
    return watch.seconds();
}

}  // namespace

double fastestRun(const std::function<std::unique_ptr<Runner>()>& make, std::int64_t steps) {
    double best = 0;
    double spent = 0;
    for (int i = 0; i < kTimedRuns && spent < kTimedSeconds; ++i) {
        const std::unique_ptr<Runner> runner = make();
        if (!runner) { return 0; }
        const double seconds = timeOf(*runner, steps);
        best = i == 0 ? seconds : std::min(best, seconds);
        spent += seconds;
    }
    return best;
}

}  // namespace swept::bench
