#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "limits.h"
#include "row.h"

namespace swept::tune {

/// What follows from the rows: a pure function of them, so that the same rows, whoever ran them, give the same advice.
struct Verdict {
    std::vector<std::size_t> order;  ///< rows from the cheapest on, failed ones last
    std::vector<std::size_t> front;  ///< of our rows those that no other one of ours beats in cost and in error
    int recommended = -1;            ///< row; −1 when none keeps the limits
    int nearest = -1;                ///< row of ours that comes nearest to it
};

/// Costs within this factor count as equal: the fastest of three runs, repeated on a machine that does other things,
/// differs by as much.
inline constexpr double kCostNoise = 1.15;

Verdict judge(const Subject& subject, const Knowledge& known, const std::vector<Limit>& limits);

/// The front, the recommended row (>), what the scene has now (=) and Box2D, one line each.
void writeTable(std::ostream& out, const Subject& subject, const std::vector<Limit>& limits, const Knowledge& known,
                const Verdict& verdict);

/// How the cost of advice compares with that of the scene as it is, by a clock that others disturb: ": 0.4 of what the
/// scene costs now". Empty where nothing could be timed.
/// @param isKept  whether the scene as it is keeps the errors
std::string costText(double cost, double now, bool isKept);

/// "f32, 120 Hz, 4 sub-steps with 1 relaxation pass, continuous off".
std::string settingsText(const Subject& subject, const Config& config);

}  // namespace swept::tune
