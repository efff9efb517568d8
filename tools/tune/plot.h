#pragma once

#include <string>
#include <vector>

#include "verdict.h"

namespace swept::tune {

/// The names of all files that `plotRows` writes.
std::vector<std::string> plottedFiles();

/// Error against cost of all rows, as DIRECTORY/tune.png and tune.svg, with their data and script beside them. With one
/// limit the error is the measure; with several, the part of what is accepted of the worst.
/// @return what was drawn, or why not; `error` when a file could not be written
std::string plotRows(const std::string& directory, const Subject& subject, const std::vector<Limit>& limits,
                     const Knowledge& known, const Verdict& verdict, std::string& error);

}  // namespace swept::tune
