#include <algorithm>
#include <ostream>

#include "../writers/csv_writer.h"
#include "../writers/number_text.h"
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

const auto kFamily = [](const OverlapRow& row) { return row.family; };

/// One block for each family: ns a pair, % false, volume.
void writeData(std::ostream& out, std::span<const OverlapRow> rows) {
    for (const std::string& family : distinct(rows, kFamily)) {
        out << '"' << family << "\"\n";
        for (const OverlapRow& row : rows) {
            if (row.family == family) {
                out << roundedText(row.nanoseconds, 6) << ' ' << roundedText(100 * row.falseShare, 6) << " \""
                    << row.rung << "\"\n";
            }
        }
        out << "\n\n";
    }
}

/// A panel for each family, names beside the points.
void writeScript(std::ostream& out, std::span<const OverlapRow> rows) {
    const auto families = distinct(rows, kFamily);
    out << kPlotStyle
        << "set terminal pngcairo size 1440,760 font 'sans,11'\nset output 'overlap.png'\nset multiplot layout 2,3\n"
           "set logscale x\nset xrange [3:20000]\nset yrange [-5:110]\nset xlabel 'ns per pair'\n"
           "set ylabel 'pairs apart that pass, %'\nunset key\n";
    for (std::size_t i = 0; i < families.size(); ++i) {
        out << "set title '" << families[i] << "'\nplot 'overlap.dat' index " << i
            << " using 1:2 with points ls 5 ps 1.8, '' index " << i
            << " every 2 using 1:2:3 with labels left offset 0.9,-0.6, '' index " << i
            << " every 2::1 using 1:2:3 with labels left offset 0.9,0.8\n";
    }
    out << "unset multiplot\n";
}

}  // namespace

void writeOverlapTable(std::ostream& out, std::span<const OverlapRow> rows) {
    for (const std::string& family : distinct(rows, kFamily)) {
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
