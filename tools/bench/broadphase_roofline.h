#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include "broadphase_bench.h"

namespace swept::bench {

/// What this machine does at best in one thread, measured by loops that do nothing else.
struct MachineLimits {
    double bytesPerSecond = 0;     ///< read in order from memory, far more than fits into the caches
    double comparesPerSecond = 0;  ///< one box against many that are in the first cache, result kept as a bit
};
MachineLimits measureLimits();

/// How near pair finding comes to it.
struct RooflineRow {
    BroadphaseRow row;
    double readTime = 0;     ///< ns a step at least: every box once, every pair once, at the machine's bandwidth
    double compareTime = 0;  ///< ns a step at least: the box tests it made, at the machine's throughput

    double limit() const { return readTime > compareTime ? readTime : compareTime; }
    double share() const { return row.pairTime > 0 ? limit() / (row.pairTime * row.movedPerStep) : 0; }
};
/// @param rows  those of the methods that tell their box tests are taken
std::vector<RooflineRow> rooflineOf(std::span<const BroadphaseRow> rows, const MachineLimits& limits);

void writeRoofline(std::ostream& out, std::span<const RooflineRow> rows, const MachineLimits& limits);

}  // namespace swept::bench
