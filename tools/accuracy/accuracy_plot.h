#pragma once

#include <span>
#include <string>

#include "accuracy_bench.h"

namespace swept::accuracy {

/// Error against cost, both logarithmic, a panel for each scene. Errors of 0 stand in a band at the bottom.
/// @return what was drawn, or why not; `error` when it could not be written or drawn
std::string plotTrade(const std::string& directory, std::span<const Row> rows, std::string& error);

}  // namespace swept::accuracy
