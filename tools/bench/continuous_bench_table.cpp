#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <ostream>
#include <sstream>

#include <swept/samples/scene_names.h>

#include "../writers/number_text.h"
#include "continuous_bench.h"
#include "gnuplot.h"

namespace swept::bench {
namespace {

std::string nameOf(SceneContinuous mode) {
    return std::string(namesOf<SceneContinuous>()[static_cast<std::size_t>(mode)]);
}

std::string percent(double share) {
    if (std::isnan(share)) { return "-"; }
    if (share == 0) { return "0"; }
    return roundedText(100 * share, 3) + " %";
}
std::string percent(int some, int all) { return percent(all > 0 ? static_cast<double>(some) / all : 0); }

std::string length(double metres) {
    if (std::isinf(metres)) { return "> 82 m"; }
    return metres < 1 ? roundedText(100 * metres, 3) + " cm" : roundedText(metres, 3) + " m";
}

}  // namespace

void writeModeTable(std::ostream& out, const std::vector<ModeRow>& rows) {
    out << "| mode | missed | of balls | ghosts | time lost | energy error | ns a body-step | escaped the box |\n"
           "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const ModeRow& row : rows) {
        out << "| `" << nameOf(row.mode) << "` | " << percent(row.missed, row.shots) << " | "
            << percent(row.ballsMissed, row.balls) << " | " << percent(row.ghosts, row.passers) << " | "
            << percent(row.timeLost) << " | " << percent(row.energyError) << " | " << roundedText(row.nanoseconds, 3)
            << " | " << percent(row.escaped) << " |\n";
    }
}

void writeThicknessTable(std::ostream& out, const std::vector<ThicknessRow>& rows) {
    out << "| mode off, wall needed at |";
    for (const double speed : kThicknessSpeeds) { out << ' ' << roundedText(speed) << " m/s |"; }
    out << "\n| --- |";
    for (std::size_t i = 0; i < std::size(kThicknessSpeeds); ++i) { out << " --- |"; }
    out << '\n';
    for (const ThicknessRow& row : rows) {
        out << "| " << row.shape << " |";
        for (const double metres : row.metres) { out << ' ' << length(metres) << " |"; }
        out << '\n';
    }
}

void writeContinuousCsv(std::ostream& out, const std::vector<ModeRow>& modes, const std::vector<ThicknessRow>& walls) {
    out << "table,row,column,value\r\n";
    for (const ModeRow& row : modes) {
        const auto cell = [&](const char* column, double value) {
            out << "modes," << nameOf(row.mode) << ',' << column << ',' << roundedText(value, 9) << "\r\n";
        };
        cell("shots", row.shots);
        cell("missed", row.missed);
        cell("balls", row.balls);
        cell("ballsMissed", row.ballsMissed);
        cell("passers", row.passers);
        cell("ghosts", row.ghosts);
        cell("timeLost", row.timeLost);
        cell("energyError", row.energyError);
        cell("nanosecondsPerBodyStep", row.nanoseconds);
        cell("escaped", row.escaped);
    }
    for (const ThicknessRow& row : walls) {
        for (std::size_t i = 0; i < row.metres.size(); ++i) {
            out << "thickness," << row.shape << ',' << roundedText(kThicknessSpeeds[i]) << ','
                << roundedText(row.metres[i], 9) << "\r\n";
        }
    }
}

std::string plotThickness(const std::string& directory, const std::vector<ThicknessRow>& rows, std::string& error) {
    std::ofstream data(directory + "/wall-thickness.dat");
    data << "# speed (m/s), wall that holds (m) for each shape\n";
    for (std::size_t i = 0; i < std::size(kThicknessSpeeds); ++i) {
        data << roundedText(kThicknessSpeeds[i]);
        for (const ThicknessRow& row : rows) {
            data << ' ' << (std::isinf(row.metres[i]) ? std::string("NaN") : roundedText(row.metres[i], 6));
        }
        data << '\n';
    }
    std::ofstream script(directory + "/wall-thickness.gp");
    script << "set terminal pngcairo size 960,600 font 'sans,12'\nset border 3\nset tics nomirror\n"
              "set grid lc rgb '#dddddd' lw 1\nset output 'wall-thickness.png'\n"
              "set title 'How thick must a wall be for discrete collision (mode off, 60 Hz)?'\n"
              "set logscale xy\nset xrange [2.5:1300]\nset yrange [0.007:60]\n"
              "set xlabel 'speed (m/s)'\nset ylabel 'thinnest wall that nothing passes (m)'\nset key left top\n"
              "plot x/60 with lines lw 2 dt 2 lc rgb '#777777' title 'way of one step'";
    const char* const colours[] = {"#1f77b4", "#ff7f0e", "#d62728", "#2ca02c"};
    for (std::size_t i = 0; i < rows.size(); ++i) {
        script << ", \\\n     'wall-thickness.dat' using 1:" << i + 2 << " with linespoints lw 2 pt 7 ps 1.3 lc rgb '"
               << colours[i % std::size(colours)] << "' title '" << rows[i].shape << "'";
    }
    script << '\n';
    data.close();
    script.close();
    if (!data || !script) {
        error = "--plots: cannot write to " + directory;
        return {};
    }
    switch (runGnuplot(directory, "wall-thickness.gp")) {
        case GnuplotState::drawn:
            return "plot " + directory + "/wall-thickness.png";
        case GnuplotState::notInstalled:
            return "gnuplot is not installed: data and script are in " + directory;
        case GnuplotState::refused:
            return "gnuplot refused the script in " + directory;
    }
    return {};
}

}  // namespace swept::bench
