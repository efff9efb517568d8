#pragma once

#include <functional>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

#include "broadphase_bench.h"

namespace swept::bench {

/// One way of enlarging boxes on one scene, with the default implementation.
struct MarginRow {
    std::string scene;
    MarginRule rule;
    double renewedShare = 0;  ///< boxes renewed, of those whose bounds moved
    double falsePairs = 0;    ///< alive, whose bounds do not overlap, per pair whose bounds do
    double nsPerMoved = 0;    ///< of a step, per box whose bounds moved
};

/// Margins from none to the whole extent, each without and with a few steps of motion ahead.
std::vector<MarginRow> benchMargins(const BroadphaseBenchSettings& settings, const BroadphaseProgress& progress);

void writeMarginTable(std::ostream& out, std::span<const MarginRow> rows);
void writeMarginCsv(std::ostream& out, std::span<const MarginRow> rows);

}  // namespace swept::bench
