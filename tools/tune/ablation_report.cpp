#include <cmath>
#include <limits>
#include <ostream>

#include "../bench/text_table.h"
#include "../writers/csv_writer.h"
#include "../writers/number_text.h"
#include "ablation.h"

namespace swept::tune {
namespace {

/// A change in whole per cent; below one per cent with one digit that counts.
std::string percent(double part) {
    const double change = 100 * (part - 1);
    if (!std::isfinite(change)) { return "-"; }  // nothing could be timed
    const double rounded = std::fabs(change) < 1 ? change : std::round(change);
    const int digits = std::fabs(change) < 1 ? 1 : std::numeric_limits<double>::digits10;
    return (rounded > 0 ? "+" : "") + roundedText(rounded, digits) + " %";
}

std::string judgement(const Ablated& one) {
    if (!one.isPresent) { return "not there"; }
    if (!one.refusal.empty()) { return "could not be tried"; }
    return one.isNeeded ? "needed" : "can go";
}

std::vector<std::string> cellsOf(const std::string& name, const Ablated& one, const Ablation& ablation,
                                 const std::vector<Limit>& limits) {
    std::vector<std::string> cells{name, judgement(one)};
    if (!one.isPresent || !one.row.verdict.empty()) {
        cells.resize(5 + limits.size(), one.row.verdict.empty() ? "" : one.row.verdict);
        return cells;
    }
    cells.push_back(roundedText(one.change, 2));
    cells.push_back(bench::threeDigits(1e3 * one.row.cost));
    cells.push_back(percent(one.row.cost / ablation.whole.cost));
    for (const Limit& limit : limits) {
        const double error = one.row.errors[limit.measure];
        cells.push_back(std::isnan(error) ? "-" : roundedText(error, 2));
    }
    return cells;
}

}  // namespace

void writeAblation(std::ostream& out, const std::vector<Limit>& limits, const Ablation& ablation) {
    std::vector<std::string> head{"without", "", "change, m", "ms per s", "cost"};
    for (const Limit& limit : limits) {
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        head.push_back(std::string(info.name) + (std::string(info.unit) == "1" ? "" : std::string(", ") + info.unit));
    }
    bench::TextTable table(head);
    Ablated nothing;
    nothing.row = ablation.whole;
    std::vector<std::string> first = cellsOf("(nothing)", nothing, ablation, limits);
    first[1] = "";
    table.add(first);
    for (const Ablated& one : ablation.single) { table.add(cellsOf(one.features.front(), one, ablation, limits)); }
    std::vector<std::string> last = cellsOf("all that can go", ablation.lean, ablation, limits);
    last[1] = ablation.lean.features.empty() ? "nothing" : "";
    table.add(last);
    table.write(out);
    for (const Ablated& one : ablation.single) {
        if (!one.refusal.empty()) { out << one.features.front() << " could not be tried: " << one.refusal << '\n'; }
    }
    out << "change: farthest that a body gets from where it is with the feature. Parts of the model may go where that "
           "is "
        << roundedText(ablation.visible, 2)
        << " m at most,\nwhich nobody sees; parts of the method (continuous collision, bullets, sub-steps, relaxation, "
           "sleep) "
           "where the accepted\nerrors allow it. What would be more work without it stays.\nms per s: processor time "
           "of the "
           "steps of a simulated second\n";
}

void writeAblationCsv(std::ostream& out, const Ablation& ablation) {
    std::string text = "without,judgement,changeMetres,costPerSecond,work,verdict";
    for (const measures::MeasureInfo& info : measures::allMeasures()) { text += std::string(",") + info.name; }
    text += '\n';
    const auto write = [&](const std::string& name, const std::string& judged, const Ablated& one) {
        text += csvField(name) + ',' + judged + ',';
        appendNumber(text, one.change);
        text += ',';
        appendNumber(text, one.row.cost);
        text += ',';
        appendNumber(text, one.row.work);
        text += ',' + csvField(one.refusal.empty() ? one.row.verdict : one.row.verdict + ": " + one.refusal);
        for (std::size_t i = 0; i < measures::kMeasureCount; ++i) {
            const double error = one.row.errors[static_cast<measures::Measure>(i)];
            text += ',';
            if (!std::isnan(error)) { appendNumber(text, error); }
        }
        text += '\n';
    };
    Ablated nothing;
    nothing.row = ablation.whole;
    write("nothing", "", nothing);
    for (const Ablated& one : ablation.single) { write(one.features.front(), judgement(one), one); }
    std::string together;
    for (const std::string& name : ablation.lean.features) { together += (together.empty() ? "" : " + ") + name; }
    write(together.empty() ? "nothing can go" : together, "leanest", ablation.lean);
    out << text;
}

}  // namespace swept::tune
