#include "accuracy_plot.h"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <vector>

#include "../bench/plot_files.h"
#include "../writers/number_text.h"

namespace swept::accuracy {
namespace {

/// What is drawn, in the order of the run.
struct Trade {
    std::span<const Row> rows;
    std::vector<std::string> scenes;
    std::vector<std::string> contestants;

    explicit Trade(std::span<const Row> all) : rows(all) {
        for (const Row& row : rows) {
            addNew(scenes, row.scene);
            addNew(contestants, row.contestant);
        }
    }
    static void addNew(std::vector<std::string>& names, const std::string& name) {
        if (std::find(names.begin(), names.end(), name) == names.end()) { names.push_back(name); }
    }
    bool hasPoints(std::size_t scene, std::size_t contestant) const {
        return std::any_of(rows.begin(), rows.end(), [&](const Row& row) {
            return row.scene == scenes[scene] && row.contestant == contestants[contestant] && isDrawn(row);
        });
    }
    static bool isDrawn(const Row& row) { return row.verdict.empty() && !row.values.empty() && row.microseconds > 0; }
};

/// Where errors of 0 stand, for which a logarithmic axis has no place: in a band below all others.
class ZeroBand {
public:
    ZeroBand(const Trade& trade, const std::string& scene) {
        double least = 1;
        for (const Row& row : trade.rows) {
            if (row.scene != scene || !Trade::isDrawn(row)) { continue; }
            const double error = row.values[0].value;
            isEmpty_ = isEmpty_ && error > 0;
            if (error > 0) { least = std::min(least, error); }
        }
        top_ = std::floor(std::log10(least)) - 0.15;  // between the tics of powers of ten
    }
    bool isEmpty() const { return isEmpty_; }
    double bottom() const { return std::pow(10, top_ - 0.7); }
    double middle() const { return std::pow(10, top_ - 0.35); }
    double top() const { return std::pow(10, top_); }

private:
    bool isEmpty_ = true;
    double top_ = 0;
};

void writeData(std::ostream& out, const Trade& trade) {
    out << "# a block for each scene and contestant: us per simulated second, error\n";
    for (const std::string& scene : trade.scenes) {
        for (const std::string& contestant : trade.contestants) {
            out << '"' << contestant << "\"\n";
            for (const Row& row : trade.rows) {
                if (row.scene == scene && row.contestant == contestant && Trade::isDrawn(row)) {
                    out << roundedText(row.microseconds, 6) << ' ' << roundedText(row.values[0].value, 6) << '\n';
                }
            }
            out << "\n\n";
        }
    }
}

void writePanel(std::ostream& out, const Trade& trade, std::size_t scene) {
    const ZeroBand zeros(trade, trade.scenes[scene]);
    const std::string place = roundedText(zeros.middle(), 6);
    out << "set title '" << trade.scenes[scene] << "'\n";
    if (zeros.isEmpty()) {
        out << "unset object\nset yrange [*:*]\nset ytics auto\n";
    } else {
        out << "set object 1 rectangle from graph 0,graph 0 to graph 1,first " << roundedText(zeros.top(), 6)
            << " fs solid noborder fc rgb '#eeeeee' behind\nset yrange [" << roundedText(zeros.bottom(), 6)
            << ":*]\nset ytics auto\nset ytics add ('0' " << place << ")\n";
    }
    out << "plot ";
    const char* separator = "";
    for (std::size_t i = 0; i < trade.contestants.size(); ++i) {
        if (!trade.hasPoints(scene, i)) { continue; }  // of an empty block gnuplot warns
        out << separator << "'accuracy-trade.dat' index " << scene * trade.contestants.size() + i
            << " using 1:($2 > 0 ? $2 : " << place << ") with points ls " << i + 1 << " ps 1.3 notitle";
        separator = ", \\\n     ";
    }
    out << '\n';
}

/// One for all, in a place of its own: it would stand on points.
void writeLegend(std::ostream& out, const Trade& trade) {
    out << "unset object\nunset title\nunset border\nunset tics\nunset xlabel\nunset ylabel\nunset logscale\n"
           "set xrange [0:1]\nset yrange [0:1]\nset key center center samplen 1\n"
           "plot ";
    for (std::size_t i = 0; i < trade.contestants.size(); ++i) {
        out << "NaN with points ls " << i + 1 << " ps 1.3 title '" << trade.contestants[i] << "', \\\n     ";
    }
    out << "NaN with boxes fs solid noborder fc rgb '#dddddd' title 'no error at all'\n";
}

void writeScript(std::ostream& out, const Trade& trade) {
    const std::size_t panels = trade.scenes.size() + 1;
    const std::size_t columns = std::min<std::size_t>(panels, 3);
    const std::size_t lines = (panels + columns - 1) / columns;
    out << bench::kPlotStyle << "set terminal pngcairo size " << 480 * columns << ',' << 380 * lines
        << " font 'sans,11'\nset output 'accuracy-trade.png'\nset multiplot layout " << lines << ',' << columns
        << "\nset logscale xy\nset format xy '10^{%T}'\nset xlabel 'us per simulated second'\nset ylabel 'error'\n";
    for (std::size_t i = 0; i < trade.scenes.size(); ++i) { writePanel(out, trade, i); }
    writeLegend(out, trade);
    out << "unset multiplot\n";
}

}  // namespace

std::string plotTrade(const std::string& directory, std::span<const Row> rows, std::string& error) {
    const Trade trade(rows);
    const auto data = [&](std::ostream& out) { writeData(out, trade); };
    const auto script = [&](std::ostream& out) { writeScript(out, trade); };
    return bench::drawPlots(directory, {{"accuracy-trade", data, script}}, error);
}

}  // namespace swept::accuracy
