#include "plot.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "../bench/plot_files.h"
#include "../writers/gnuplot_text.h"
#include "../writers/number_text.h"

namespace swept::tune {
namespace {

/// How the numbers of a row go into the plot.
class Axis {
public:
    Axis(const std::vector<Limit>& limits, const Knowledge& known) : limits_(limits), known_(known) {
        const auto isAsked = [](const Limit& limit) { return !limit.implied; };
        isOneMeasure_ = std::count_if(limits.begin(), limits.end(), isAsked) == 1;  // which is the first then
        double least = limit() > 0 ? limit() : 1;
        for (const Row& row : known.rows) {
            const double error = raw(row);
            least = std::isfinite(error) && error > 0 ? std::min(least, error) : least;
        }
        floor_ = least / 2;
    }

    double limit() const { return isOneMeasure_ ? limits_[0].value : 1; }
    /// An error of 0 has no place on a logarithmic axis: it stands at the bottom.
    double place(const Row& row) const { return std::max(raw(row), floor_); }
    double floor() const { return floor_; }
    bool isDrawn(const Row& row) const { return std::isfinite(raw(row)) && row.cost > 0; }
    std::string label() const {
        if (!isOneMeasure_) { return "error, as a part of what is accepted"; }
        const measures::MeasureInfo& info = measures::infoOf(limits_[0].measure);
        return std::string(info.name) + (std::string(info.unit) == "1" ? "" : std::string(", ") + info.unit);
    }

private:
    double raw(const Row& row) const {
        return isOneMeasure_ && row.verdict.empty() ? row.errors[limits_[0].measure]
                                                    : strain(row, limits_, known_.uncertainty);
    }

    const std::vector<Limit>& limits_;
    const Knowledge& known_;
    bool isOneMeasure_ = true;
    double floor_ = 0;
};

/// A block of the data file: a name, and a line for each row.
void writeBlock(std::ostream& out, const std::string& name, const std::vector<const Row*>& rows, const Axis& axis) {
    out << "# " << name << '\n';
    for (const Row* const row : rows) {
        if (axis.isDrawn(*row)) {
            out << roundedText(1e3 * row->cost, 6) << ' ' << roundedText(axis.place(*row), 6) << '\n';
        }
    }
    out << "\n\n";
}

/// What the plot shows under one name.
struct Block {
    const char* name;
    const char* style;
    std::vector<const Row*> rows;
};

void writeScript(std::ostream& out, const Subject& subject, const Axis& axis, const std::vector<Block>& blocks) {
    const std::string& name = subject.scene.name;
    const std::string title = name + (name.empty() ? "" : ": ") + "what accuracy costs";
    out << bench::kPlotStyle << "set logscale xy\nset format y '10^{%T}'\nset key outside right top vertical\n"
        << "set title " << gnuplotQuoted(title) << " noenhanced\n"
        << "set xlabel 'processor time, ms per simulated second'\nset ylabel '" << axis.label()
        << "'\nset grid\nset yrange [" << roundedText(0.7 * axis.floor(), 6) << ":]\n"
        << "do for [terminal in \"png svg\"] {\n"
        << "    if (terminal eq 'png') { set terminal pngcairo size 1100,600 font 'sans,12'; set output 'tune.png' }\n"
        << "    if (terminal eq 'svg') { set terminal svg size 1100,600 font 'sans,12'; set output 'tune.svg' }\n"
        << "    plot ";
    const char* separator = "";
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        out << separator << "'tune.dat' index " << i << ' ' << blocks[i].style << " title '" << blocks[i].name << '\'';
        separator = ", \\\n        ";
    }
    if (axis.limit() > 0) {
        out << separator << roundedText(axis.limit(), 6) << " with lines lc rgb '#444444' dt 2 title 'accepted'";
    }
    out << "\n}\n";
}

/// All of the plot but what is in its data and script.
bench::PlotFiles emptyPlot() { return {"tune", {}, {}, {"tune.svg"}}; }

}  // namespace

std::vector<std::string> plottedFiles() { return bench::filesOf(emptyPlot()); }

std::string plotRows(const std::string& directory, const Subject& subject, const std::vector<Limit>& limits,
                     const Knowledge& known, const Verdict& verdict, std::string& error) {
    const Axis axis(limits, known);
    std::vector<Block> blocks{{"front", "with steps lc rgb '#d62728' lw 1.5", {}},
                              {"f32", "with points lc rgb '#d62728' pt 7 ps 1.1", {}},
                              {"f64", "with points lc rgb '#9467bd' pt 5 ps 1.1", {}},
                              {"Box2D 2.4.1", "with points lc rgb '#1f77b4' pt 9 ps 1.3", {}},
                              {"Box2D 3 stiff", "with points lc rgb '#17becf' pt 11 ps 1.3", {}},
                              {"as the scene is now", "with points lc rgb '#000000' pt 4 ps 2 lw 2", {}},
                              {"recommended", "with points lc rgb '#2ca02c' pt 6 ps 3 lw 3", {}}};
    constexpr std::size_t kFront = 0;
    constexpr std::size_t kFirstEngine = 1;
    const std::size_t nowAt = blocks.size() - 2;
    for (const std::size_t i : verdict.front) { blocks[kFront].rows.push_back(&known.rows[i]); }
    const Config own = ownConfig(subject.scene);
    for (const Row& row : known.rows) {
        blocks[kFirstEngine + static_cast<std::size_t>(row.config.engine)].rows.push_back(&row);
        if (row.config == own) { blocks[nowAt].rows.push_back(&row); }
    }
    if (verdict.recommended >= 0) {
        blocks.back().rows.push_back(&known.rows[static_cast<std::size_t>(verdict.recommended)]);
    }
    // gnuplot does not count a block without points, and warns of it.
    std::erase_if(blocks, [&axis](const Block& block) {
        return std::none_of(block.rows.begin(), block.rows.end(), [&](const Row* row) { return axis.isDrawn(*row); });
    });
    bench::PlotFiles plot = emptyPlot();
    plot.data = [&](std::ostream& out) {
        out << "# a block each: ms of processor time per simulated second, error\n";
        for (const Block& block : blocks) { writeBlock(out, block.name, block.rows, axis); }
    };
    plot.script = [&](std::ostream& out) { writeScript(out, subject, axis, blocks); };
    return bench::drawPlots(directory, {plot}, error);
}

}  // namespace swept::tune
