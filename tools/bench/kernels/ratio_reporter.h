#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace swept::bench {

/// Prints what the console reporter prints, and keeps the medians of the benchmarks named distance/MODE/KIND/WHO.
class RatioReporter final : public benchmark::ConsoleReporter {
public:
    void ReportRuns(const std::vector<Run>& runs) override;

    /// One line per mode and kind: the median time of each contestant, and how many times faster than each other engine
    /// ours are. Nothing without medians (`--benchmark_repetitions`).
    void printRatios(std::ostream& out) const;

private:
    std::map<std::string, std::map<std::string, double>> medians_;  ///< ns per query, by MODE/KIND and WHO
};

}  // namespace swept::bench
