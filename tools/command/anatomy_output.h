#pragma once

#include <string>

#include "../toi_query.h"

namespace swept {

/// Draws the anatomy of a query (toi_anatomy.h) as a PNG, by gnuplot.
/// @return false, and one line in `error`, when the file cannot be written or gnuplot is missing; then no file is left.
bool drawAnatomy(const ToiQuery& query, const std::string& file, std::string& error);

}  // namespace swept
