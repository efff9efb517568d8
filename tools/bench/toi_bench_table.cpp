#include "toi_bench_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

#include "../writers/csv_writer.h"
#include "../writers/number_text.h"

namespace swept::bench {
namespace {

constexpr double kTail = 0.999;
constexpr const char* kReference = "certified";

std::string padded(const std::string& text, std::size_t width) {
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

/// "12 (0.0034)": how many, and how bad the worst is.
std::string withWorst(int count, double worst) {
    return count == 0 ? "0" : std::to_string(count) + " (" + roundedText(worst, 2) + ")";
}

void writeHead(std::ostream& out, const std::string& family) {
    out << '\n'
        << family << std::string(family.size() < 24 ? 24 - family.size() : 1, ' ')
        << " queries      missed (m)        late (m)       early (m)  overlap  failed  undec.  it.50%  99.9%        ns"
           "  /certif.\n";
}

void writeTally(std::ostream& out, const std::string& method, const ToiTally& tally) {
    out << "  " << method << std::string(method.size() < 23 ? 23 - method.size() : 1, ' ')
        << padded(std::to_string(tally.queries), 7) << padded(withWorst(tally.missed, tally.deepestMiss), 16)
        << padded(withWorst(tally.late, tally.deepestLate), 16) << padded(withWorst(tally.early, tally.widestGap), 16)
        << padded(std::to_string(tally.falseOverlap), 9) << padded(std::to_string(tally.failed + tally.wrongReport), 8)
        << padded(std::to_string(tally.undecided), 8);
}

std::string timeText(double nanoseconds) {
    char text[32];
    std::snprintf(text, sizeof(text), "%.0f", nanoseconds);
    return text;
}

const ToiBenchRow* referenceOf(std::span<const ToiBenchRow> rows, const std::string& family) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const ToiBenchRow& row) {
        return row.family == family && row.method == kReference;
    });
    return found == rows.end() ? nullptr : &*found;
}

double ratioOf(const ToiBenchRow& row, std::span<const ToiBenchRow> rows) {
    const ToiBenchRow* const reference = referenceOf(rows, row.family);
    return reference != nullptr && reference->nanoseconds > 0 ? row.nanoseconds / reference->nanoseconds : 0;
}

/// "-" where the engine does not tell.
std::string iterationsText(const ToiBenchRow& row, double share) {
    return row.iterations.empty() ? "-" : std::to_string(row.iterationsOf(share));
}

void writeRow(std::ostream& out, const ToiBenchRow& row, std::span<const ToiBenchRow> rows) {
    if (row.tally.queries == 0) {
        out << "  " << row.method << ": not asked\n";
        return;
    }
    writeTally(out, row.method, row.tally);
    out << padded(iterationsText(row, 0.5), 8) << padded(iterationsText(row, kTail), 8)
        << padded(timeText(row.nanoseconds), 10) << padded(roundedText(ratioOf(row, rows), 3), 9) << '\n';
}

std::string percentText(int some, int all) {
    return some == 0 || all == 0 ? "0" : roundedText(100.0 * some / all, 3) + " %";
}

/// In shares: lengths of families of all sizes cannot be compared.
void writeTotals(std::ostream& out, std::span<const ToiBenchRow> rows) {
    out << "\nall families             queries    missed      late     early   overlap    failed   undec.  fams."
           "        ns  /certified\n";
    for (const ToiBenchTotal& total : totalsOf(rows)) {
        const ToiTally& t = total.tally;
        out << "  " << total.method << std::string(total.method.size() < 23 ? 23 - total.method.size() : 1, ' ')
            << padded(std::to_string(t.queries), 7);
        for (const int some : {t.missed, t.late, t.early, t.falseOverlap, t.failed + t.wrongReport}) {
            out << padded(percentText(some, t.queries), 10);
        }
        out << padded(std::to_string(t.undecided), 9) << padded(std::to_string(total.families), 7)
            << padded(timeText(total.nanoseconds), 10) << padded(roundedText(total.ratio, 3), 12) << '\n';
    }
    out << "\nmissed, late: depth of the worst below target - tolerance; early: gap of the worst above target + "
           "tolerance;\n"
           "overlap: said and not true, or true and not said; undec.: the oracle could not decide. Iterations are "
           "each\n"
           "method's own unit. ns a query: median of passes taken in turns; over families their geometric mean.\n";
}

}  // namespace

std::vector<ToiBenchTotal> totalsOf(std::span<const ToiBenchRow> rows) {
    std::vector<ToiBenchTotal> totals;
    for (const ToiBenchRow& row : rows) {
        const auto isSame = [&](const ToiBenchTotal& total) { return total.method == row.method; };
        auto total = std::find_if(totals.begin(), totals.end(), isSame);
        if (total == totals.end()) {
            totals.push_back({row.method, {}, 0, 0, 0});
            total = totals.end() - 1;
        }
        total->tally.add(row.tally);
        const double ratio = ratioOf(row, rows);
        if (row.nanoseconds > 0 && ratio > 0) {
            ++total->families;
            total->nanoseconds += std::log(row.nanoseconds);
            total->ratio += std::log(ratio);
        }
    }
    for (ToiBenchTotal& total : totals) {
        if (total.families > 0) {
            total.nanoseconds = std::exp(total.nanoseconds / total.families);
            total.ratio = std::exp(total.ratio / total.families);
        }
    }
    return totals;
}

void writeToiTable(std::ostream& out, std::span<const ToiBenchRow> rows) {
    std::string family;
    for (const ToiBenchRow& row : rows) {
        if (row.family != family) {
            family = row.family;
            writeHead(out, family);
        }
        writeRow(out, row, rows);
    }
    writeTotals(out, rows);
}

void writeToiCsv(std::ostream& out, std::span<const ToiBenchRow> rows, const ToiBenchSettings& settings) {
    out << "family,method,seed,count,queries,right,missed,deepest_miss,late,deepest_late,early,widest_gap,"
           "false_overlap,failed,wrong_report,undecided,iterations_median,iterations_p999,ns\n";
    for (const ToiBenchRow& row : rows) {
        const ToiTally& t = row.tally;
        std::string record = csvField(row.family) + ',' + csvField(row.method);
        const auto add = [&record](double value) {
            record += ',';
            appendNumber(record, value);
        };
        record += ',' + std::to_string(settings.seed);
        for (const int value : {settings.count, t.queries, t.right, t.missed}) { add(value); }
        add(t.deepestMiss);
        add(t.late);
        add(t.deepestLate);
        add(t.early);
        add(t.widestGap);
        for (const int value : {t.falseOverlap, t.failed, t.wrongReport, t.undecided}) { add(value); }
        for (const double share : {0.5, kTail}) { record += ',' + csvField(iterationsText(row, share)); }
        add(row.nanoseconds);
        out << record << '\n';
    }
}

}  // namespace swept::bench
