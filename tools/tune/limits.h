#pragma once

#include <string>
#include <vector>

#include "row.h"

namespace swept::tune {

/// An error that the user accepts: `--max-error penetration=0.005`.
struct Limit {
    measures::Measure measure = measures::Measure::penetration;
    double value = 0;
    bool implied = false;  ///< not asked for by the user
};

/// @param typed  "MEASURE=VALUE"
/// @return false, and a line in `error`, for an unknown measure, a value that is no number or below 0, a measure given
/// twice
bool parseLimits(const std::vector<std::string>& typed, std::vector<Limit>& limits, std::string& error);

/// Adds what goes without saying, where the user said nothing about it: no more hits are missed than by the reference,
/// and no body loses more than a hundredth of the run (a mode that slows bodies down is cheap, but shows another
/// motion). An engine that does not tell of lost time is not judged by it.
void addImplied(std::vector<Limit>& limits, const Subject& subject, const Knowledge& known);

/// Why a limit makes no sense for this scene; empty when all do. A measure that says nothing of the scene cannot be
/// held, nor can one whose reference is less certain than the limit.
std::string whyMeaningless(const Subject& subject, const std::vector<Limit>& limits, const Knowledge& known);

/// The error as a part of what is accepted, of the limit that is nearest to being missed; the uncertainty of the
/// reference counts as error. Infinite when the run failed or something could not be measured, 0 over 0 is 0.
double strain(const Row& row, const std::vector<Limit>& limits, const measures::Values& uncertainty);
/// The errors above what is accepted: "penetration 0.0123 instead of 0.002 m"; of a run that failed, why.
std::string missedText(const Row& row, const std::vector<Limit>& limits, const measures::Values& uncertainty);
inline bool holds(double strain) { return strain <= 1; }

}  // namespace swept::tune
