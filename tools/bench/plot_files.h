#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace swept::bench {

/// Ten line styles and a frame, for scripts to start with.
extern const char* const kPlotStyle;

/// A plot named `name`: name.dat, and name.gp that draws name.png from it.
struct PlotFiles {
    std::string name;
    std::function<void(std::ostream&)> data;
    std::function<void(std::ostream&)> script;
    std::vector<std::string> others{};  ///< further pictures that the script draws, "tune.svg"
};

/// The names of all files that `drawPlots` writes for it.
std::vector<std::string> filesOf(const PlotFiles& plot);

/// Writes and, with gnuplot, draws. @return what was drawn, or why not; `error`, which begins with the path, when a
/// file could not be written or drawn
std::string drawPlots(const std::string& directory, const std::vector<PlotFiles>& plots, std::string& error);

}  // namespace swept::bench
