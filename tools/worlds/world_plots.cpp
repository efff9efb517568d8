#include <algorithm>
#include <ostream>

#include "../bench/plot_files.h"
#include "../writers/number_text.h"
#include "world_table.h"

namespace swept::worlds {
namespace {

std::vector<std::string> contestantsOf(const std::vector<WorldRow>& rows) {
    std::vector<std::string> names;
    for (const WorldRow& row : rows) {
        if (std::find(names.begin(), names.end(), row.contestant) == names.end()) { names.push_back(row.contestant); }
    }
    return names;
}

/// A line for each scene, a column for each contestant.
void writeTimeData(std::ostream& out, const std::vector<WorldRow>& rows) {
    const auto names = contestantsOf(rows);
    out << "scene";
    for (const std::string& name : names) { out << " \"" << name << '"'; }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        out << (i % names.size() == 0 ? "\n" + rows[i].scene : "") << ' '
            << (rows[i].times.empty() ? "?" : roundedText(1e3 * rows[i].perStep(), 6));
    }
    out << '\n';
}

void writeTimeScript(std::ostream& out, std::size_t contestants) {
    out << bench::kPlotStyle
        << "set terminal pngcairo size 1400,600 font 'sans,12'\nset output 'world-times.png'\nset datafile missing "
           "'?'\n"
           "set style data histograms\nset style fill solid\nset logscale y\nset ylabel 'ms a step'\nset xtics rotate "
           "by -35\n"
           "set key outside top horizontal\nplot for [i=2:"
        << contestants + 1 << "] 'world-times.dat' using i:xtic(1) ls (i-1) title columnheader(i)\n";
}

void writeGrowthData(std::ostream& out, const std::vector<WorldRow>& rows) {
    for (const std::string& name : contestantsOf(rows)) {
        out << '"' << name << "\"\n";
        std::string scene;
        for (const WorldRow& row : rows) {
            if (row.contestant == name && !row.times.empty()) {
                out << (!scene.empty() && scene != row.scene ? "\n" : "") << row.bodies << ' '
                    << roundedText(1e6 * row.perStep() / static_cast<double>(row.bodies), 6) << '\n';
                scene = row.scene;
            }
        }
        out << "\n\n";
    }
}

void writeGrowthScript(std::ostream& out, std::size_t contestants) {
    out << bench::kPlotStyle
        << "set output 'world-growth.png'\nset logscale xy\nset xlabel 'bodies'\nset ylabel 'us a step and body'\n"
           "set format x '10^{%T}'\nset key outside\nplot for [i=0:"
        << contestants - 1
        << "] 'world-growth.dat' index i using 1:2 with linespoints ls (i+1) lw 2 title columnheader(1)\n";
}

}  // namespace

std::string plotWorlds(const std::string& directory, const std::vector<WorldRow>& rows,
                       const std::vector<WorldRow>& growth, std::string& error) {
    std::vector<bench::PlotFiles> plots;
    if (!rows.empty()) {
        const std::size_t count = contestantsOf(rows).size();
        plots.push_back({"world-times", [&](std::ostream& out) { writeTimeData(out, rows); },
                         [count](std::ostream& out) { writeTimeScript(out, count); }});
    }
    if (!growth.empty()) {
        const std::size_t count = contestantsOf(growth).size();
        plots.push_back({"world-growth", [&](std::ostream& out) { writeGrowthData(out, growth); },
                         [count](std::ostream& out) { writeGrowthScript(out, count); }});
    }
    return bench::drawPlots(directory, plots, error);
}

}  // namespace swept::worlds
