#include <algorithm>
#include <ostream>

#include "../csv_writer.h"
#include "../number_text.h"
#include "overlap_bench.h"
#include "plot_files.h"
#include "text_table.h"

namespace swept::bench {
namespace {

std::string percentText(double share) { return threeDigits(100 * share) + " %"; }

template <class Get>
std::vector<std::string> distinct(std::span<const OverlapRow> rows, const Get& get) {
    std::vector<std::string> values;
    for (const OverlapRow& row : rows) {
        if (std::find(values.begin(), values.end(), get(row)) == values.end()) { values.push_back(get(row)); }
    }
    return values;
}

/// One block for each rung: ns a pair, % false, family.
void writeData(std::ostream& out, std::span<const OverlapRow> rows) {
    constexpr double kNone = 0.1;  // where "none" stands on the logarithmic axis
    for (const std::string& rung : distinct(rows, [](const OverlapRow& row) { return row.rung; })) {
        out << '"' << rung << "\"\n";
        for (const OverlapRow& row : rows) {
            if (row.rung == rung) {
                out << roundedText(row.nanoseconds, 6) << ' ' << roundedText(std::max(kNone, 100 * row.falseShare), 6)
                    << " \"" << row.family << "\"\n";
            }
        }
        out << "\n\n";
    }
}

void writeScript(std::ostream& out, std::span<const OverlapRow> rows) {
    const auto rungs = distinct(rows, [](const OverlapRow& row) { return row.rung; });
    out << kPlotStyle
        << "set output 'overlap.png'\nset title 'Bounding volumes: cost against false positives'\n"
           "set logscale xy\nset xlabel 'ns per pair'\nset ylabel 'pairs apart that pass, %'\nset yrange [0.08:150]\n"
           "set ytics ('none' 0.1, '1' 1, '3' 3, '10' 10, '30' 30, '100' 100)\nset key outside right top\n"
           "plot for [i=0:"
        << rungs.size() - 1
        << "] 'overlap.dat' index i using 1:2 with points ls (i+1) lw 2 ps 1.8 title columnheader(1), \\\n"
           "     for [i=0:"
        << rungs.size() - 1 << "] '' index i using 1:2:3 with labels offset 0,0.9 font ',9' notitle\n";
}

}  // namespace

void writeOverlapTable(std::ostream& out, std::span<const OverlapRow> rows) {
    for (const std::string& family : distinct(rows, [](const OverlapRow& row) { return row.family; })) {
        out << '\n' << family << '\n';
        TextTable table({"", "ns a pair", "passing", "false", "ns with GJK behind it"});
        for (const OverlapRow& row : rows) {
            if (row.family != family) { continue; }
            table.add({row.rung, threeDigits(row.nanoseconds), percentText(row.passing), percentText(row.falseShare),
                       threeDigits(row.withGjk)});
            if (!row.missesNone) { table.add({"  misses touching pairs!"}); }
        }
        table.write(out);
    }
}

void writeOverlapCsv(std::ostream& out, std::span<const OverlapRow> rows, const OverlapBenchSettings& settings) {
    out << "family,rung,seed,count,ns,passing,false_share,ns_with_gjk,misses_none\n";
    for (const OverlapRow& row : rows) {
        std::string record = csvField(row.family) + ',' + csvField(row.rung) + ',' + std::to_string(settings.seed) +
                             ',' + std::to_string(settings.count);
        for (const double value : {row.nanoseconds, row.passing, row.falseShare, row.withGjk}) {
            record += ',';
            appendNumber(record, value);
        }
        out << record << ',' << (row.missesNone ? 1 : 0) << '\n';
    }
}

std::string plotOverlap(const std::string& directory, std::span<const OverlapRow> rows, std::string& error) {
    return drawPlots(directory,
                     {{"overlap", [&](std::ostream& out) { writeData(out, rows); },
                       [&](std::ostream& out) { writeScript(out, rows); }}},
                     error);
}

}  // namespace swept::bench
