#pragma once

#include <span>
#include <string>

#include "toi_bench.h"

namespace swept::bench {

/// Writes the data and the gnuplot script of three plots into an existing directory and has gnuplot draw them as PNG:
/// toi-cost (accuracy against cost), toi-iterations (of the family ca_worst), toi-turns (misses against turn per step).
/// @return what there is to tell the user: what was drawn, or that gnuplot is missing; `error` is set when a file could
///         not be written or gnuplot refused a script.
std::string plotToiBench(const std::string& directory, std::span<const ToiBenchRow> rows,
                         std::span<const TurnPoint> turns, std::string& error);

}  // namespace swept::bench
