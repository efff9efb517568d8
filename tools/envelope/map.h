#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "row.h"

namespace swept::envelope {

/// Draws the map of a slice, a panel for each engine: colour is the error over its bound, a line runs between inside
/// and outside. Writes NAME.dat and NAME.gp, and NAME.png where gnuplot is installed.
/// @return what was drawn, or why not; `error` when a file could not be written or drawn
std::string drawMap(const std::string& directory, const Slice& slice, const Rows& rows,
                    const std::vector<tune::Engine>& engines, std::string& error);

/// The limits of a slice in words, metres and hertz.
void writeSummary(std::ostream& out, const Slice& slice, const Rows& rows, const std::vector<tune::Engine>& engines);

/// The map as text, a line each: "stack,f32,1000,####...", in the order of `Slice::y`.
std::string limitLines(const Slice& slice, const Rows& rows, const std::vector<tune::Engine>& engines);

}  // namespace swept::envelope
