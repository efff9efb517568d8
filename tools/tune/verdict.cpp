#include "verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <ostream>

#include <swept/samples/scene_names.h>

#include "../bench/text_table.h"
#include "../writers/number_text.h"

namespace swept::tune {
namespace {

bool isOurs(const Row& row) { return isOurs(row.config.engine); }

template <class Number>
std::string plural(Number count, const std::string& one) {
    return std::to_string(count) + ' ' + one + (count == 1 ? "" : (one.ends_with("pass") ? "es" : "s"));
}

std::string hertz(const Subject& subject, const Config& config) {
    return roundedText(1 / std::ldexp(subject.scene.settings.dt, config.dtPower), 4) + " Hz";
}

std::string errorText(double value) { return std::isnan(value) ? "-" : roundedText(value, 2); }

/// "37 %", "4100 %".
std::string partText(double part) {
    constexpr double kWhole = 100;  // percents from which on three digits are whole numbers
    const double percents = 100 * part;
    return (percents < kWhole ? roundedText(percents, 3) : roundedText(std::round(percents), 15)) + " %";
}

/// The error as a part of what is accepted. Of nothing there are no parts.
std::string acceptedText(const Row& row, const std::vector<Limit>& limits, const measures::Values& uncertainty) {
    const double part = strain(row, limits, uncertainty);
    if (std::isinf(part)) { return "-"; }
    const auto isOverNothing = [&](const Limit& limit) {
        return limit.value == 0 && strain(row, {limit}, uncertainty) > 0;
    };
    return std::any_of(limits.begin(), limits.end(), isOverNothing) ? "over" : partText(part);
}

std::vector<std::string> cellsOf(const Subject& subject, const std::vector<Limit>& limits, const Row& row,
                                 const std::string& part, char mark) {
    const Config& config = row.config;
    const bool isPeer = !isOurs(row);
    std::vector<std::string> cells{std::string(1, mark) + ' ' + nameOf(config.engine), hertz(subject, config),
                                   std::to_string(config.subSteps), isPeer ? "-" : std::to_string(config.relaxPasses)};
    const auto mode = namesOf<SceneContinuous>()[static_cast<std::size_t>(config.continuous)];
    cells.emplace_back(isPeer ? "-" : mode);
    cells.push_back(config.toiTolerance ? roundedText(*config.toiTolerance, 2) : "-");
    const auto kind = namesOf<SceneBroadphase>()[static_cast<std::size_t>(config.broadphase)];
    cells.emplace_back(isPeer ? "-" : kind);
    cells.push_back(row.verdict.empty() ? bench::threeDigits(1e3 * row.cost) : "-");
    for (const Limit& limit : limits) {
        cells.push_back(row.verdict.empty() ? errorText(row.errors[limit.measure]) : row.verdict);
    }
    cells.push_back(part);
    return cells;
}

/// Settings that differ from what the scene has.
int changesOf(const Config& config, const Config& own) {
    int changes = config.engine == own.engine ? 0 : 1;
    changes += config.dtPower == own.dtPower ? 0 : 1;
    changes += config.subSteps == own.subSteps ? 0 : 1;
    changes += config.relaxPasses == own.relaxPasses ? 0 : 1;
    changes += config.continuous == own.continuous ? 0 : 1;
    changes += config.toiTolerance == own.toiTolerance ? 0 : 1;
    return changes + (config.broadphase == own.broadphase ? 0 : 1);
}

/// Of two rows that cost the same, the one to be preferred: it lets less through, or else has fewer changes to the
/// scene, or less work. What a clock cannot tell apart must not talk anyone out of continuous collision.
bool isPreferred(const Row& a, const Row& b, const Config& own) {
    if (a.config.continuous != b.config.continuous) { return isStronger(a.config.continuous, b.config.continuous); }
    const int changesA = changesOf(a.config, own);
    const int changesB = changesOf(b.config, own);
    return changesA != changesB ? changesA < changesB : a.work < b.work;
}

/// Whether nothing repeatable says that the row is dearer than the cheapest one. What is counted leaves out what
/// precisions and broadphases cost.
bool costsTheSame(const Row& row, const Row& cheapest) {
    if (row.cost <= kCostNoise * cheapest.cost) { return true; }
    return row.config.engine == cheapest.config.engine && row.config.broadphase == cheapest.config.broadphase &&
           row.work > 0 && row.work <= kWorkNoise * cheapest.work;
}

/// Rows of Box2D that no cheaper one of its own beats.
bool isOnOwnFront(const Knowledge& known, const std::vector<Limit>& limits, const Row& row) {
    const double part = strain(row, limits, known.uncertainty);
    return std::none_of(known.rows.begin(), known.rows.end(), [&](const Row& other) {
        return other.config.engine == row.config.engine && other.verdict.empty() && other.cost < row.cost &&
               strain(other, limits, known.uncertainty) <= part;
    });
}

}  // namespace

Verdict judge(const Subject& subject, const Knowledge& known, const std::vector<Limit>& limits) {
    const Config own = ownConfig(subject.scene);
    const auto strainOf = [&](std::size_t i) { return strain(known.rows[i], limits, known.uncertainty); };
    Verdict verdict;
    verdict.order.resize(known.rows.size());
    std::iota(verdict.order.begin(), verdict.order.end(), std::size_t{0});
    const auto cheaper = [&](std::size_t a, std::size_t b) {
        const Row& rowA = known.rows[a];
        const Row& rowB = known.rows[b];
        if (rowA.verdict.empty() != rowB.verdict.empty()) { return rowA.verdict.empty(); }
        return rowA.cost < rowB.cost;
    };
    std::stable_sort(verdict.order.begin(), verdict.order.end(), cheaper);
    double least = std::numeric_limits<double>::infinity();
    const Row* cheapest = nullptr;
    for (const std::size_t i : verdict.order) {
        const Row& row = known.rows[i];
        const double part = strainOf(i);
        if (!isOurs(row) || std::isinf(part)) { continue; }
        if (part < least) {
            least = part;
            verdict.front.push_back(i);
            if (!holds(part) || verdict.nearest < 0 || !holds(strainOf(static_cast<std::size_t>(verdict.nearest)))) {
                verdict.nearest = static_cast<int>(i);
            }
        }
        if (!holds(part)) { continue; }
        if (cheapest == nullptr) {
            cheapest = &row;
            verdict.recommended = static_cast<int>(i);
        } else if (costsTheSame(row, *cheapest) &&
                   isPreferred(row, known.rows[static_cast<std::size_t>(verdict.recommended)], own)) {
            verdict.recommended = static_cast<int>(i);
        }
    }
    return verdict;
}

void writeTable(std::ostream& out, const Subject& subject, const std::vector<Limit>& limits, const Knowledge& known,
                const Verdict& verdict) {
    std::vector<std::string> head{"  engine",   "step",         "sub-steps",  "passes",
                                  "continuous", "tolerance, m", "broadphase", "ms per s"};
    for (const Limit& limit : limits) {
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        head.push_back(std::string(info.name) + (std::string(info.unit) == "1" ? "" : std::string(", ") + info.unit));
    }
    head.emplace_back("of what is accepted");
    bench::TextTable table(head);
    const Config own = ownConfig(subject.scene);
    for (const std::size_t i : verdict.order) {
        const Row& row = known.rows[i];
        const bool isRecommended = static_cast<int>(i) == verdict.recommended;
        const bool isOwn = row.config == own;
        const bool isOnFront = std::find(verdict.front.begin(), verdict.front.end(), i) != verdict.front.end();
        if (isRecommended || isOwn || isOnFront || (!isOurs(row) && isOnOwnFront(known, limits, row))) {
            const char mark = isRecommended ? '>' : (isOwn ? '=' : (isOnFront ? '*' : ' '));
            table.add(cellsOf(subject, limits, row, acceptedText(row, limits, known.uncertainty), mark));
        }
    }
    table.write(out);
    out << "> recommended  = as the scene is now  * on the front: nothing of ours is both cheaper and nearer\n"
        << "ms per s: processor time of the steps of a simulated second; sub-steps of Box2D 2.4.1 are velocity "
           "iterations\n";
}

std::string costText(double cost, double now, bool isKept) {
    if (!(cost > 0) || !(now > 0)) { return ""; }
    const double part = cost / now;
    const bool isEqual = part <= kCostNoise && part >= 1 / kCostNoise;
    if (isEqual && isKept) { return ": no saving that could be measured"; }
    const std::string ratio =
        isEqual ? "about" : (part < 1 ? roundedText(part, 2) + " of" : roundedText(part, 3) + " times");
    return ": " + ratio + " what the scene costs now" +
           (isKept ? "" : " (as it is, the scene does not keep these errors)");
}

std::string settingsText(const Subject& subject, const Config& config) {
    std::string text = std::string(nameOf(config.engine)) + ", " + hertz(subject, config) + ", ";
    if (!isOurs(config.engine)) {
        return text + plural(config.subSteps, config.engine == Engine::box2d ? "velocity iteration" : "sub-step");
    }
    text += plural(config.subSteps, "sub-step") + " with " + plural(config.relaxPasses, "relaxation pass");
    text += ", continuous ";
    text += namesOf<SceneContinuous>()[static_cast<std::size_t>(config.continuous)];
    if (config.toiTolerance) { text += ", tolerance " + roundedText(*config.toiTolerance, 2) + " m"; }
    text += ", broadphase ";
    text += namesOf<SceneBroadphase>()[static_cast<std::size_t>(config.broadphase)];
    return text;
}

}  // namespace swept::tune
