#pragma once

#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "broadphase_bench.h"

namespace swept::bench {

/// How the time of a step grows with the number of proxies, all else equal: least squares over the sizes.
struct GrowthRow {
    std::string scene;
    std::string method;
    double exponent = 0;
};
std::vector<GrowthRow> growthOf(std::span<const BroadphaseRow> rows);

/// What one of ours is against another engine, over all cases in which both were measured.
struct RivalRow {
    std::string method;
    std::string rival;
    double geometricMean = 0;  ///< rival's time over ours: above 1 we are faster
    double worst = 0;
    std::string worstCase;
    int cases = 0;
};
/// @param rows  of which the time to hand over and to find pairs is taken
std::vector<RivalRow> rivalry(std::span<const BroadphaseRow> rows);

/// For each distribution, a line for each method with its time per renewed box in all sizes.
void writeDistributionTables(std::ostream& out, std::span<const BroadphaseRow> rows);
/// For each scene a line for each method.
void writePeerTables(std::ostream& out, std::span<const BroadphaseRow> rows);
void writeRivalry(std::ostream& out, std::span<const BroadphaseRow> rows);
void writeBroadphaseCsv(std::ostream& out, std::span<const BroadphaseRow> rows);

}  // namespace swept::bench
