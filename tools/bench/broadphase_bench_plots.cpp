#include "broadphase_bench_plots.h"

#include <algorithm>
#include <ostream>

#include "../writers/number_text.h"
#include "plot_files.h"

namespace swept::bench {
namespace {

template <class Rows, class Get>
std::vector<std::string> distinct(const Rows& rows, const Get& get) {
    std::vector<std::string> values;
    for (const auto& row : rows) {
        if (std::find(values.begin(), values.end(), get(row)) == values.end()) { values.push_back(get(row)); }
    }
    return values;
}

const auto kScene = [](const auto& row) { return row.scene; };
const auto kMethod = [](const auto& row) { return row.method; };

/// Panels side by side in rows of `columns`.
void writeGrid(std::ostream& out, const char* name, std::size_t panels, std::size_t columns) {
    const std::size_t lines = (panels + columns - 1) / columns;
    out << kPlotStyle << "set terminal pngcairo size " << 480 * columns << ',' << 380 * lines
        << " font 'sans,11'\nset output '" << name << ".png'\nset multiplot layout " << lines << ',' << columns << '\n';
}

void writeGrowthData(std::ostream& out, std::span<const BroadphaseRow> rows) {
    out << "# a block for each scene and method: proxies, ns per renewed box\n";
    for (const std::string& scene : distinct(rows, kScene)) {
        for (const std::string& method : distinct(rows, kMethod)) {
            out << '"' << method << "\"\n";
            for (const BroadphaseRow& row : rows) {
                if (row.scene == scene && row.method == method) {
                    out << row.proxies << ' ' << roundedText(row.time(), 6) << '\n';
                }
            }
            out << "\n\n";
        }
    }
}

void writeGrowthScript(std::ostream& out, std::span<const BroadphaseRow> rows) {
    const auto scenes = distinct(rows, kScene);
    const std::size_t methods = distinct(rows, kMethod).size();
    writeGrid(out, "broadphase-growth", scenes.size() + 1, std::min<std::size_t>(scenes.size() + 1, 4));
    out << "set logscale xy\nset xlabel 'proxies'\nset ylabel 'ns per renewed box'\nset format x '10^{%T}'\nunset "
           "key\n";
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        out << "set title '" << scenes[i] << "'\nplot for [i=0:" << methods - 1 << "] 'broadphase-growth.dat' index (i+"
            << i * methods << ") using 1:2 with linespoints ls (i+1) lw 2 ps 1.1 title columnheader(1)\n";
    }
    // The key alone in the last panel.
    out << "set key center center\nunset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\n"
           "unset grid\nset xrange [1:10]\nset yrange [1:10]\nplot for [i=0:"
        << methods - 1
        << "] 'broadphase-growth.dat' index i using (0.5):(0.5) with linespoints ls (i+1) lw 2 ps 1.1 "
           "title columnheader(1)\nunset multiplot\n";
}

void writeSceneData(std::ostream& out, std::span<const BroadphaseRow> rows) {
    const auto methods = distinct(rows, kMethod);
    out << "scene";
    for (const std::string& method : methods) { out << " \"" << method << '"'; }
    out << '\n';
    for (const std::string& scene : distinct(rows, kScene)) {
        out << '"' << scene << '"';
        for (const std::string& method : methods) {
            const auto found = std::find_if(rows.begin(), rows.end(), [&](const BroadphaseRow& row) {
                return row.scene == scene && row.method == method;
            });
            out << ' ' << (found == rows.end() ? "?" : roundedText(1e-3 * found->stepTime(), 6));
        }
        out << '\n';
    }
}

void writeSceneScript(std::ostream& out, std::span<const BroadphaseRow> rows) {
    out << kPlotStyle
        << "set terminal pngcairo size 1200,600 font 'sans,12'\nset output 'broadphase-scenes.png'\n"
           "set title 'Enlarged boxes in, new pairs out: time of a step'\nset ylabel 'us a step'\nset logscale y\n"
           "set datafile missing '?'\nset style data histograms\nset style histogram clustered gap 1\n"
           "set style fill solid 0.85 noborder\nset key outside right top\n"
           "plot for [i=2:"
        << distinct(rows, kMethod).size() + 1
        << "] 'broadphase-scenes.dat' using i:xtic(1) title columnheader(i) ls (i-1)\n";
}

void writeMarginData(std::ostream& out, std::span<const MarginRow> rows) {
    out << "# a block for each scene and number of steps ahead: renewed %, false pairs per true one, ns, margin\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const MarginRow& row = rows[i];
        if (row.rule.extentRatio == 0) {
            out << (i == 0 ? "" : "\n\n") << '"' << roundedText(static_cast<double>(row.rule.stepsAhead), 3)
                << " steps ahead\"\n";
        }
        out << roundedText(100 * row.renewedShare, 6) << ' ' << roundedText(row.falsePairs, 6) << ' '
            << roundedText(row.nsPerMoved, 6) << ' ' << roundedText(static_cast<double>(row.rule.extentRatio), 6)
            << '\n';
    }
}

void writeMarginScript(std::ostream& out, std::span<const MarginRow> rows) {
    const auto scenes = distinct(rows, kScene);
    const auto lines = distinct(rows, [](const MarginRow& row) { return std::to_string(row.rule.stepsAhead); }).size();
    writeGrid(out, "broadphase-margin", scenes.size(), std::min<std::size_t>(scenes.size(), 2));
    out << "set logscale x\nset xlabel 'boxes renewed, % of those that moved'\nset ylabel 'false pairs per true one'\n"
           "set key bottom left\nset xrange [2:110]\nset yrange [0:6]\n";
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        out << "set title '" << scenes[i] << ": margins 0 to 1 extent'\nplot for [i=0:" << lines - 1
            << "] 'broadphase-margin.dat' index (i+" << i * lines
            << ") using 1:2 with linespoints ls (i+4) lw 2 ps 1.1 title columnheader(1)\n";
    }
    out << "unset multiplot\n";
}

}  // namespace

std::string plotBroadphase(const std::string& directory, std::span<const BroadphaseRow> distributions,
                           std::span<const BroadphaseRow> peers, std::span<const MarginRow> margins,
                           std::string& error) {
    std::vector<PlotFiles> plots;
    if (!distributions.empty()) {
        plots.push_back({"broadphase-growth", [&](std::ostream& out) { writeGrowthData(out, distributions); },
                         [&](std::ostream& out) { writeGrowthScript(out, distributions); }});
    }
    if (!peers.empty()) {
        plots.push_back({"broadphase-scenes", [&](std::ostream& out) { writeSceneData(out, peers); },
                         [&](std::ostream& out) { writeSceneScript(out, peers); }});
    }
    if (!margins.empty()) {
        plots.push_back({"broadphase-margin", [&](std::ostream& out) { writeMarginData(out, margins); },
                         [&](std::ostream& out) { writeMarginScript(out, margins); }});
    }
    return drawPlots(directory, plots, error);
}

}  // namespace swept::bench
