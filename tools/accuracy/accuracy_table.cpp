#include "accuracy_table.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

#include "../bench/plot_files.h"
#include "../bench/text_table.h"
#include "../writers/csv_writer.h"
#include "../writers/number_text.h"

namespace swept::accuracy {
namespace {

template <class Get>
std::vector<std::string> distinct(std::span<const Row> rows, const Get& get) {
    std::vector<std::string> values;
    for (const Row& row : rows) {
        if (std::find(values.begin(), values.end(), get(row)) == values.end()) { values.push_back(get(row)); }
    }
    return values;
}
std::string groupOf(const Row& row) { return row.group; }
std::string sceneOf(const Row& row) { return row.scene; }
std::string refusalOf(const Row& row) { return row.refusal; }
std::string contestantOf(const Row& row) { return row.contestant; }

/// Two digits, in a form that stays short over many decades.
std::string errorText(double value) {
    char text[32];
    const bool isPlain = value == 0 || (value >= 1e-3 && value < 1e3);
    std::snprintf(text, sizeof text, isPlain ? "%.2g" : "%.1e", value);
    return text;
}

std::string cellOf(const Row& row, std::size_t measure) {
    if (!row.verdict.empty()) { return row.verdict; }
    return measure < row.values.size() ? errorText(row.values[measure].value) : "-";
}

std::string labelOf(const std::vector<const Row*>& line, std::size_t measure) {
    for (const Row* const row : line) {
        if (measure < row->values.size()) {
            const MeasuredValue& value = row->values[measure];
            return value.name + (value.unit == "1" ? "" : ", " + value.unit);
        }
    }
    return "";
}

void writeGroup(std::ostream& out, std::span<const Row> rows, const std::string& group) {
    const std::vector<std::string> contestants = distinct(rows, contestantOf);
    std::vector<std::string> head{group, "error"};
    head.insert(head.end(), contestants.begin(), contestants.end());
    bench::TextTable table(head);
    for (const std::string& scene : distinct(rows, sceneOf)) {
        std::vector<const Row*> line;
        std::size_t measures = 1;
        for (const Row& row : rows) {
            if (row.group == group && row.scene == scene) {
                line.push_back(&row);
                measures = std::max(measures, row.values.size());
            }
        }
        for (std::size_t m = 0; m < measures && !line.empty(); ++m) {
            std::vector<std::string> cells{m == 0 ? scene : "", labelOf(line, m)};
            for (const std::string& contestant : contestants) {
                const auto found = std::find_if(line.begin(), line.end(),
                                                [&](const Row* row) { return row->contestant == contestant; });
                cells.push_back(found == line.end() ? "-" : cellOf(**found, m));
            }
            table.add(cells);
        }
    }
    out << '\n';
    table.write(out);
}

}  // namespace

void writeTables(std::ostream& out, std::span<const Row> rows) {
    for (const std::string& group : distinct(rows, groupOf)) { writeGroup(out, rows, group); }
    out << "\nErrors are magnitudes, 0 is perfect; those without a unit are parts of the whole.\n";
    for (const std::string& refusal : distinct(rows, refusalOf)) {
        if (!refusal.empty()) { out << "-: " << refusal << ".\n"; }
    }
}

void writeTradeTables(std::ostream& out, std::span<const Row> rows) {
    for (const std::string& scene : distinct(rows, sceneOf)) {
        bench::TextTable table({scene, "Hz", "sub-steps", "us per s", "error"});
        std::vector<const Row*> order;
        for (const Row& row : rows) {
            if (row.scene == scene) { order.push_back(&row); }
        }
        std::stable_sort(order.begin(), order.end(),
                         [](const Row* a, const Row* b) { return a->microseconds < b->microseconds; });
        for (const Row* const row : order) {
            table.add({row->contestant, roundedText(row->hertz, 3), std::to_string(row->subSteps),
                       roundedText(row->microseconds, 3), cellOf(*row, 0)});
        }
        out << '\n';
        table.write(out);
    }
}

void writeCsv(std::ostream& out, std::span<const Row> rows) {
    out << "group,scene,contestant,hertz,subSteps,microsecondsPerSecond,verdict,measure,unit,error\n";
    for (const Row& row : rows) {
        std::string start = row.group + ',' + row.scene + ',' + csvField(row.contestant) + ',';
        appendNumber(start, row.hertz);
        start += ',' + std::to_string(row.subSteps) + ',';
        appendNumber(start, row.microseconds);
        start += ',' + csvField(row.verdict) + ',';
        if (row.values.empty()) { out << start << ",,\n"; }
        for (const MeasuredValue& value : row.values) {
            std::string record = start + csvField(value.name) + ',' + csvField(value.unit) + ',';
            appendNumber(record, value.value);
            out << record << '\n';
        }
    }
}

std::string plotTrade(const std::string& directory, std::span<const Row> rows, std::string& error) {
    const std::vector<std::string> scenes = distinct(rows, sceneOf);
    const std::vector<std::string> contestants = distinct(rows, contestantOf);
    const auto data = [&](std::ostream& out) {
        out << "# a block for each scene and contestant: us per simulated second, error\n";
        for (const std::string& scene : scenes) {
            for (const std::string& contestant : contestants) {
                out << '"' << contestant << "\"\n";
                for (const Row& row : rows) {
                    const bool isMine = row.scene == scene && row.contestant == contestant;
                    if (isMine && row.verdict.empty() && !row.values.empty() && row.microseconds > 0) {
                        out << roundedText(row.microseconds, 6) << ' ' << roundedText(row.values[0].value, 6) << '\n';
                    }
                }
                out << "\n\n";
            }
        }
    };
    const auto script = [&](std::ostream& out) {
        const std::size_t columns = std::min<std::size_t>(scenes.size(), 3);
        const std::size_t lines = (scenes.size() + columns - 1) / columns;
        out << bench::kPlotStyle << "set terminal pngcairo size " << 480 * columns << ',' << 380 * lines
            << " font 'sans,11'\nset output 'accuracy-trade.png'\nset multiplot layout " << lines << ',' << columns
            << "\nset logscale xy\nset format xy '10^{%T}'\nset xlabel 'us per simulated second'\nset ylabel 'error'\n";
        for (std::size_t i = 0; i < scenes.size(); ++i) {
            out << "set title '" << scenes[i] << "'\nplot for [i=0:" << contestants.size() - 1
                << "] 'accuracy-trade.dat' index (i+" << i * contestants.size()
                << ") using 1:2 with points ls (i+1) ps 1.3 title columnheader(1)\n";
        }
        out << "unset multiplot\n";
    };
    return bench::drawPlots(directory, {{"accuracy-trade", data, script}}, error);
}

}  // namespace swept::accuracy
