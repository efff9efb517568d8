#include "map.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "../bench/plot_files.h"
#include "../writers/number_text.h"

namespace swept::envelope {
namespace {

/// Ends of the colours: powers of ten of error over bound.
constexpr double kDarkestInside = -3;
constexpr double kDarkestOutside = 2;

double colourOf(const Slice& slice, const Row& row) {
    const double ratio = row.value / slice.bound;
    return ratio > 0 ? std::clamp(std::log10(ratio), kDarkestInside, kDarkestOutside) : kDarkestInside;
}

bool isInside(const Slice& slice, const Rows& rows, tune::Engine engine, std::size_t ix, std::size_t iy) {
    const Row* const row = rows.find(slice.x.values[ix], slice.y.values[iy], engine);
    return row != nullptr && row->isInside(slice);
}

/// Two blocks: the cells at whole numbers of their places, and the edges between inside and outside.
void writePanel(std::ostream& out, const Slice& slice, const Rows& rows, tune::Engine engine) {
    const std::size_t width = slice.x.values.size();
    const std::size_t height = slice.y.values.size();
    out << "# " << tune::nameOf(engine) << ": column, line, power of ten of error over bound\n";
    for (std::size_t iy = 0; iy < height; ++iy) {
        for (std::size_t ix = 0; ix < width; ++ix) {
            const Row* const row = rows.find(slice.x.values[ix], slice.y.values[iy], engine);
            out << ix << ' ' << iy << ' ' << (row == nullptr ? "NaN" : roundedText(colourOf(slice, *row))) << '\n';
        }
    }
    out << "\n\n# edges: start, way\n";
    for (std::size_t iy = 0; iy < height; ++iy) {
        for (std::size_t ix = 0; ix < width; ++ix) {
            const bool here = isInside(slice, rows, engine, ix, iy);
            const auto x = static_cast<double>(ix);
            const auto y = static_cast<double>(iy);
            if (ix + 1 < width && here != isInside(slice, rows, engine, ix + 1, iy)) {
                out << x + 0.5 << ' ' << y - 0.5 << " 0 1\n";
            }
            if (iy + 1 < height && here != isInside(slice, rows, engine, ix, iy + 1)) {
                out << x - 0.5 << ' ' << y + 0.5 << " 1 0\n";
            }
        }
    }
    // A block without points is an error to gnuplot.
    out << "-2 -2 0 0\n\n\n";
}

/// Names for some of the places along an axis, so many that they do not run into each other.
std::string ticsOf(const Axis& axis) {
    constexpr std::size_t kMost = 8;
    const std::size_t every = (axis.values.size() + kMost - 1) / kMost;
    std::string tics;
    for (std::size_t i = 0; i < axis.values.size(); i += every) {
        tics +=
            std::string(tics.empty() ? "(" : ", ") + "'" + roundedText(axis.values[i], 2) + "' " + std::to_string(i);
    }
    return tics + ")";
}

void writeScript(std::ostream& out, const Slice& slice, const std::vector<tune::Engine>& engines) {
    constexpr int kPanelWidth = 400;
    constexpr int kHeight = 400;
    out << "set terminal pngcairo size " << kPanelWidth * static_cast<int>(engines.size()) << ',' << kHeight
        << " font 'sans,10'\nset output '" << slice.name << ".png'\n"
        << "set multiplot layout 1," << engines.size() << " title '" << slice.title << "' noenhanced\n"
        << "set border 3\nset tics nomirror out\nset xtics rotate by -40\nunset key\n"
        << "set xtics " << ticsOf(slice.x) << "\nset ytics " << ticsOf(slice.y) << "\nset xlabel '" << slice.x.label
        << "' noenhanced\nset ylabel '" << slice.y.label << "' noenhanced\n"
        << "set xrange [-0.5:" << slice.x.values.size() - 1 << ".5]\nset yrange [-0.5:" << slice.y.values.size() - 1
        << ".5]\nset cbrange [" << kDarkestInside << ':' << kDarkestOutside << "]\nset cblabel 'error over bound ("
        << roundedText(slice.bound) << ")'\nset format cb '10^{%g}'\n"
        << "set palette defined (" << kDarkestInside << " '#2166ac', -0.001 '#d1e5f0', 0 '#fddbc7', " << kDarkestOutside
        << " '#b2182b')\n";
    for (std::size_t i = 0; i < engines.size(); ++i) {
        out << "set title '" << tune::nameOf(engines[i]) << "'\nplot '" << slice.name << ".dat' index " << 2 * i
            << " using 1:2:3 with image, '' index " << 2 * i + 1
            << " using 1:2:3:4 with vectors nohead lw 2.5 lc rgb 'black'\n";
    }
    out << "unset multiplot\n";
}

/// How far the axis goes beyond a limit.
const char* endOf(const Slice& slice, double limit) {
    return limit == slice.x.values.back() ? " (end of the map)" : "";
}

}  // namespace

std::string drawMap(const std::string& directory, const Slice& slice, const Rows& rows,
                    const std::vector<tune::Engine>& engines, std::string& error) {
    const auto data = [&](std::ostream& out) {
        for (const tune::Engine engine : engines) { writePanel(out, slice, rows, engine); }
    };
    const auto script = [&](std::ostream& out) { writeScript(out, slice, engines); };
    return bench::drawPlots(directory, {{slice.name, data, script}}, error);
}

void writeSummary(std::ostream& out, const Slice& slice, const Rows& rows, const std::vector<tune::Engine>& engines) {
    out << slice.name << ": " << slice.title << "\n  inside: " << slice.measure << ", at most "
        << roundedText(slice.bound) << "; along " << slice.x.label << '\n';
    for (const tune::Engine engine : engines) {
        out << "  " << tune::nameOf(engine) << '\n';
        for (const double y : slice.y.values) {
            const auto limit = limitOf(slice, rows, y, engine);
            out << "    " << slice.y.label << " = " << roundedText(y, 3) << ": ";
            if (!limit) {
                out << "nowhere on this map\n";
            } else {
                out << "up to " << roundedText(*limit, 3) << endOf(slice, *limit) << ": " << slice.told(*limit, y)
                    << '\n';
            }
        }
    }
}

std::string limitLines(const Slice& slice, const Rows& rows, const std::vector<tune::Engine>& engines) {
    std::string lines;
    for (const tune::Engine engine : engines) {
        for (const double y : slice.y.values) {
            lines += slice.name + ',' + tune::nameOf(engine) + ',' + roundedText(y, 6) + ',' +
                     lineOf(slice, rows, y, engine) + '\n';
        }
    }
    return lines;
}

}  // namespace swept::envelope
