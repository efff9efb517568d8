#include "limits.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "../measures/measure_run.h"
#include "../writers/number_text.h"

namespace swept::tune {
namespace {

std::string nameOf(const Limit& limit) { return measures::infoOf(limit.measure).name; }

/// Part of the run that a body may lose where nobody asked about it.
constexpr double kLostPart = 0.01;

/// A short run that only shows which measures say anything of the scene.
measures::Values glance(const Subject& subject) {
    std::string ignored;
    RunnerOptions options;
    options.measure = true;
    const auto runner = makeRunner(subject.scene, options, ignored);
    if (!runner) { return {}; }
    return measures::measuredAlone(subject.scene, measures::record(*runner, {subject.scene.settings.dt, 2, 1, 1}));
}

}  // namespace

bool parseLimits(const std::vector<std::string>& typed, std::vector<Limit>& limits, std::string& error) {
    for (const std::string& text : typed) {
        const std::size_t equals = text.find('=');
        const std::string name = text.substr(0, equals);
        const auto measure = measures::measureNamed(name);
        if (equals == std::string::npos) {
            error = "--max-error " + text + ": expected MEASURE=VALUE";
            return false;
        }
        if (!measure) {
            error = "--max-error " + text + ": unknown measure" + measures::suggestionFor(name);
            return false;
        }
        Limit limit{*measure, 0, false};
        const char* const end = text.data() + text.size();
        const auto [stop, failure] = std::from_chars(text.data() + equals + 1, end, limit.value);
        if (failure != std::errc{} || stop != end || !std::isfinite(limit.value) || limit.value < 0) {
            error = "--max-error " + text + ": the value must be a number, at least 0, in " +
                    measures::infoOf(*measure).unit;
            return false;
        }
        for (const Limit& other : limits) {
            if (other.measure == *measure) {
                error = "--max-error " + name + ": given twice";
                return false;
            }
        }
        limits.push_back(limit);
    }
    return true;
}

void addImplied(std::vector<Limit>& limits, const Subject& subject, const Knowledge& known) {
    using measures::Measure;
    const double duration = static_cast<double>(subject.ticks) * subject.scene.settings.dt;
    const Limit hits{Measure::missedHits, known.uncertainty[Measure::missedHits], true};
    const Limit time{Measure::lostTime, kLostPart * duration, true};
    for (const Limit& implied : {hits, time}) {
        const auto isGiven = [&](const Limit& limit) { return limit.measure == implied.measure; };
        if (std::none_of(limits.begin(), limits.end(), isGiven)) { limits.push_back(implied); }
    }
}

std::string whyMeaningless(const Subject& subject, const std::vector<Limit>& limits, const Knowledge& known) {
    const measures::Values seen = glance(subject);
    for (const Limit& limit : limits) {
        if (limit.implied) { continue; }
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        const double uncertainty = known.uncertainty[limit.measure];
        const double shown = info.needsReference ? uncertainty : seen[limit.measure];
        if (std::isnan(shown)) {
            return "--max-error " + nameOf(limit) + ": says nothing of this scene (" + info.definition + ")";
        }
        if (info.needsReference && uncertainty > limit.value) {
            return "--max-error " + nameOf(limit) + ": the reference (" + known.reference +
                   ") is itself uncertain by " + roundedText(uncertainty, 2) + ' ' + info.unit +
                   ", as the scene is chaotic in it: accept more, run " +
                   "shorter, or name a measure without a reference, such as penetration";
        }
    }
    return "";
}

double strain(const Row& row, const std::vector<Limit>& limits, const measures::Values& uncertainty) {
    constexpr double kFailed = std::numeric_limits<double>::infinity();
    if (!row.verdict.empty()) { return kFailed; }
    double worst = 0;
    for (const Limit& limit : limits) {
        const bool compares = measures::infoOf(limit.measure).needsReference;
        const double error = row.errors[limit.measure] + (compares ? uncertainty[limit.measure] : 0);
        if (std::isnan(error) && limit.implied) { continue; }
        if (std::isnan(error)) { return kFailed; }
        // Of nothing there are no parts: what is accepted is missed, however small the error.
        const double part = limit.value > 0 ? error / limit.value : std::max(1 + error, std::nextafter(1.0, 2.0));
        worst = std::max(worst, error == 0 ? 0 : part);
    }
    return worst;
}

std::string missedText(const Row& row, const std::vector<Limit>& limits, const measures::Values& uncertainty) {
    if (!row.verdict.empty()) { return row.verdict; }
    std::string text;
    for (const Limit& limit : limits) {
        if (holds(strain(row, {limit}, uncertainty))) { continue; }
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        const double error = row.errors[limit.measure] + (info.needsReference ? uncertainty[limit.measure] : 0);
        text += (text.empty() ? "" : ", ") + std::string(info.name) + ' ' + roundedText(error, 3) + " instead of " +
                roundedText(limit.value) + (std::string(info.unit) == "1" ? "" : std::string(" ") + info.unit);
    }
    return text;
}

}  // namespace swept::tune
