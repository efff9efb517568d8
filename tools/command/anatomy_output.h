#pragma once

#include <string>

#include "../toi/toi_query.h"

namespace swept {

/// Draws the anatomy of a query (toi_anatomy.h) as a PNG, by gnuplot.
/// @param input  where the query came from: it is not overwritten; empty: no file
/// @return false, and one line in `error`, when the file cannot be written or gnuplot is missing; then no file is left.
bool drawAnatomy(const ToiQuery& query, const std::string& file, const std::string& input, std::string& error);

}  // namespace swept
