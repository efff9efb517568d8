#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "continuous_bench.h"

namespace swept::bench {

/// What a crowd costs in one engine, and what became of it.
struct CrowdRow {
    std::string crowd;
    std::string engine;
    double microseconds = 0;  ///< a step, the fastest of some runs, engines in turn
    double nanoseconds = 0;   ///< a body-step
    double outside = 0;       ///< share of the bodies that left
    double energyError = 0;   ///< relative, signed
    double lost = 0;          ///< share of all body-time; negative: the engine does not tell
};

/// The storm of 1000 bodies at 50 m/s in a box, which meet each other; 1000 bodies at 50 m/s that do not, among 10 000
/// segments; 1000 slow ones in a box. Ours, ours without continuous collision, and the engines that are there.
std::vector<CrowdRow> benchCrowds(const ContinuousBenchSettings& settings, const std::function<void(int)>& progress);
inline constexpr int kCrowdCount = 3;

void writeCrowdTable(std::ostream& out, const std::vector<CrowdRow>& rows);
void writeCrowdCsv(std::ostream& out, const std::vector<CrowdRow>& rows);

}  // namespace swept::bench
