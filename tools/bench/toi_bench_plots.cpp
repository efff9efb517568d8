#include "toi_bench_plots.h"

#include <algorithm>
#include <functional>
#include <ostream>

#include "../writers/number_text.h"
#include "plot_files.h"
#include "toi_bench_table.h"

namespace swept::bench {
namespace {

/// Where "none at all" stands on a logarithmic axis of percents.
constexpr double kNone = 1e-3;

double inPercent(int some, int all) { return some == 0 || all == 0 ? kNone : 100.0 * some / all; }

const char* const kStyle =
    "set terminal pngcairo size 960,600 font 'sans,12'\n"
    "set border 3\nset tics nomirror\nset grid lc rgb '#dddddd' lw 1\n"
    "set style line 1 lc rgb '#999999' pt 1\nset style line 2 lc rgb '#8c564b' pt 2\n"
    "set style line 3 lc rgb '#e377c2' pt 3\nset style line 4 lc rgb '#2ca02c' pt 5\n"
    "set style line 5 lc rgb '#1f77b4' pt 7\nset style line 6 lc rgb '#ff7f0e' pt 9\n"
    "set style line 7 lc rgb '#9467bd' pt 11\nset style line 8 lc rgb '#d62728' pt 13\n"
    "set style line 9 lc rgb '#000000' pt 4\nset style line 10 lc rgb '#17becf' pt 6\n"
    "set style line 11 lc rgb '#6b5b00' pt 8\nset style line 12 lc rgb '#9edae5' pt 10\n";

const char* const kPercentAxis =
    "set logscale y\nset yrange [0.0007:150]\n"
    "set ytics ('none' 0.001, '0.01 %%' 0.01, '0.1 %%' 0.1, '1 %%' 1, '10 %%' 10, '100 %%' 100)\n";

std::vector<std::string> methodsOf(std::span<const ToiBenchRow> rows) {
    std::vector<std::string> names;
    for (const ToiBenchTotal& total : totalsOf(rows)) { names.push_back(total.method); }
    return names;
}

void writeCostData(std::ostream& out, std::span<const ToiBenchRow> rows) {
    out << "# method, ns a query (geometric mean over the families), % missed or late, % wrong in any way\n";
    for (const ToiBenchTotal& total : totalsOf(rows)) {
        out << '"' << total.method << "\" " << roundedText(total.nanoseconds, 6) << ' '
            << roundedText(inPercent(total.tally.deep(), total.tally.queries), 6) << ' '
            << roundedText(inPercent(total.tally.wrong(), total.tally.queries), 6) << '\n';
    }
}

void writeCostScript(std::ostream& out, std::span<const ToiBenchRow> rows) {
    out << kStyle << kPercentAxis
        << "set output 'toi-cost.png'\nset title 'Accuracy against cost, all families'\n"
           "set logscale x\nset xrange [200:60000]\nset xlabel 'ns per query (geometric mean over the families)'\n"
           "set xtics (200, 500, 1000, 2000, 5000, 10000, 20000, 50000)\n"
           "set ylabel 'share of the answers'\nset key outside right top\n"
           "plot 'toi-cost.dat' using 2:3:(0):($4-$3) with vectors nohead lw 2 lc rgb '#bbbbbb' notitle, \\\n"
           "     '' using 2:4 with points pt 6 ps 2.4 lw 1 lc rgb '#777777' title 'ring: wrong in any way'";
    const std::vector<std::string> methods = methodsOf(rows);
    for (std::size_t i = 0; i < methods.size(); ++i) {
        out << ", \\\n     '' every ::" << i << "::" << i << " using 2:3 with points ls " << i + 1
            << " lw 2 ps 1.8 title '" << methods[i] << '\'';
    }
    out << '\n';
}

/// Classes of iterations: 1, 2, 3 … 4, 5 … 8 and so on; the last is open.
constexpr int kClasses = 13;

int classOf(int iterations) {
    int result = 0;
    for (int end = 1; end < iterations && result < kClasses - 1; end *= 2) { ++result; }
    return result;
}

std::string classText(int index) {
    const int end = 1 << index;
    std::string text;
    if (index == kClasses - 1) {
        text = '>';
        return text += std::to_string(end / 2);
    }
    if (end > 2) { text = std::to_string(end / 2 + 1) + '-'; }
    return text += std::to_string(end);
}

std::vector<ToiBenchRow> worstCaseRows(std::span<const ToiBenchRow> rows) {
    std::vector<ToiBenchRow> found;
    for (const ToiBenchRow& row : rows) {
        // Those that take one look or two have no histogram.
        if (row.family == nameOf(ToiFamily::caWorst) && row.iterationsOf(1) > 2) { found.push_back(row); }
    }
    return found;
}

void writeIterationsData(std::ostream& out, std::span<const ToiBenchRow> rows) {
    const std::vector<ToiBenchRow> shown = worstCaseRows(rows);
    out << "iterations";
    for (const ToiBenchRow& row : shown) { out << " \"" << row.method << '"'; }
    out << '\n';
    for (int index = 0; index < kClasses; ++index) {
        out << '"' << classText(index) << '"';
        for (const ToiBenchRow& row : shown) {
            const auto isInClass = [index](int iterations) { return classOf(iterations) == index; };
            const auto inClass = std::count_if(row.iterations.begin(), row.iterations.end(), isInClass);
            out << ' '
                << roundedText(100.0 * static_cast<double>(inClass) / static_cast<double>(row.iterations.size()));
        }
        out << '\n';
    }
}

void writeIterationsScript(std::ostream& out, std::span<const ToiBenchRow> rows) {
    out << kStyle
        << "set output 'toi-iterations.png'\nset title 'Iterations on ca\\_worst'\n"
           "set xlabel 'iterations (in the unit of each method)'\nset ylabel 'share of the queries, %'\n"
           "set style data histograms\nset style histogram clustered gap 1\nset style fill solid 0.85 noborder\n"
           "set key top right\nset yrange [0:*]\nset xtics rotate by -35\nplot ";
    const std::vector<std::string> methods = methodsOf(rows);
    int column = 2;
    for (const ToiBenchRow& row : worstCaseRows(rows)) {
        const auto style = 1 + std::find(methods.begin(), methods.end(), row.method) - methods.begin();
        out << (column == 2 ? "'toi-iterations.dat'" : ", \\\n     ''") << " using " << column
            << ":xtic(1) title columnheader(" << column << ") ls " << style;
        ++column;
    }
    out << (column == 2 ? "0 notitle\n" : "\n");
}

void writeTurnsData(std::ostream& out, std::span<const TurnPoint> turns, const std::vector<std::string>& methods) {
    out << "# one block for each method: turn of either body in radians, % missed or late\n";
    for (const std::string& method : methods) {
        out << '"' << method << "\"\n";
        for (const TurnPoint& point : turns) {
            if (point.method == method && point.tally.queries > 0) {
                out << roundedText(point.turn) << ' '
                    << roundedText(inPercent(point.tally.deep(), point.tally.queries), 6) << '\n';
            }
        }
        out << "\n\n";
    }
}

void writeTurnsScript(std::ostream& out, std::span<const ToiBenchRow> rows) {
    out << kStyle << kPercentAxis
        << "set output 'toi-turns.png'\nset title 'Missed or late against the turn of both bodies in one step'\n"
           "set logscale x\nset xrange [0.009:30]\nset xlabel 'turn of either body, radians per step'\n"
           "set xtics ('0.01' 0.01, '0.03' 0.03, '0.1' 0.1, '0.3' 0.3, 'pi/4' 0.785, 'pi/2' 1.57, 'pi' 3.14, "
           "'2 pi' 6.28, '4 pi' 12.57, '8 pi' 25.13)\n"
           "set ylabel 'share of the answers'\nset key outside right top\n"
           "plot for [i=0:"
        << methodsOf(rows).size() - 1
        << "] 'toi-turns.dat' index i using 1:2 with linespoints ls (i+1) lw 2 ps 1.3 title columnheader(1)\n";
}

}  // namespace

std::string plotToiBench(const std::string& directory, std::span<const ToiBenchRow> rows,
                         std::span<const TurnPoint> turns, std::string& error) {
    const std::vector<std::string> methods = methodsOf(rows);
    const auto plot = [&](const char* name, const std::function<void(std::ostream&)>& data,
                          void (*script)(std::ostream&, std::span<const ToiBenchRow>)) {
        return PlotFiles{name, data, [rows, script](std::ostream& out) { script(out, rows); }};
    };
    return drawPlots(
        directory,
        {plot(
             "toi-cost", [&](std::ostream& out) { writeCostData(out, rows); }, writeCostScript),
         plot(
             "toi-iterations", [&](std::ostream& out) { writeIterationsData(out, rows); }, writeIterationsScript),
         plot(
             "toi-turns", [&](std::ostream& out) { writeTurnsData(out, turns, methods); }, writeTurnsScript)},
        error);
}

}  // namespace swept::bench
