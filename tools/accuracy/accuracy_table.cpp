#include "accuracy_table.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

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

}  // namespace swept::accuracy
