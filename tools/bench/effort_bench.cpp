#include "effort_bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <ostream>

#include "../writers/number_text.h"
#include "stopwatch.h"

namespace swept::bench {
namespace {

constexpr std::array kFixed{4, 6, 8, 12, 16, 24, 32, 48, 64};

double counterOf(const RunReport& report, const char* name) {
    for (const NamedNumber& counter : report.counters) {
        if (counter.name == name) { return counter.value; }
    }
    return 0;
}

std::int64_t stepsOf(const EffortScene& entry, const SceneDescription& scene) {
    return std::llround(entry.seconds / scene.settings.dt);
}

/// @param budgets  what the errors are judged by
EffortRun play(const EffortScene& entry, const SceneDescription& scene, const SettingsDescription& budgets,
               Precision precision) {
    std::string error;
    const auto runner = makeRunner(scene, {.precision = precision, .measure = true}, error);
    for (std::int64_t i = 0; i < stepsOf(entry, scene); ++i) { runner->step(); }
    const RunReport report = runner->report();
    EffortRun run;
    run.penetration = report.deepestPenetration;
    run.jointError = report.largestJointError;
    run.missed = counterOf(report, "overPenetration") + counterOf(report, "overJointError");
    run.bodiesAgain = counterOf(report, "bodiesAgain");
    run.bodySubSteps = counterOf(report, "bodySubSteps");
    if (budgets.maxPenetration) { run.error = run.penetration / *budgets.maxPenetration; }
    if (budgets.maxJointError) { run.error = std::max(run.error, run.jointError / *budgets.maxJointError); }
    return run;
}

double secondsOf(const EffortScene& entry, const SceneDescription& scene, Precision precision) {
    std::string error;
    const auto runner = makeRunner(scene, {.precision = precision}, error);
    const Stopwatch watch;
    for (std::int64_t i = 0; i < stepsOf(entry, scene); ++i) { runner->step(); }
    return watch.seconds();
}

SceneDescription withFixed(SceneDescription scene, int subSteps) {
    scene.settings.subSteps = subSteps;
    scene.settings.maxPenetration.reset();
    scene.settings.maxJointError.reset();
    return scene;
}

std::string millimetres(double metres) { return roundedText(1e3 * metres, 3) + " mm"; }

std::string budgetText(const EffortRow& row) {
    std::string text;
    if (row.maxPenetration > 0) { text = millimetres(row.maxPenetration); }
    if (row.maxJointError > 0) {
        text += (text.empty() ? "" : ", ") + std::string("joints ") + millimetres(row.maxJointError);
    }
    return text;
}

std::string ratioText(double some, double all) {
    return all > 0 && std::isfinite(all) ? roundedText(some / all, 2) : "-";
}

}  // namespace

EffortRow effortRow(const EffortScene& entry, Precision precision, const EffortBenchSettings& settings) {
    SceneDescription scene = entry.make();
    for (std::optional<double>* const budget : {&scene.settings.maxPenetration, &scene.settings.maxJointError}) {
        if (*budget) { **budget *= settings.budget; }
    }
    EffortRow row;
    row.scene = entry.name;
    row.precision = precision;
    row.maxPenetration = scene.settings.maxPenetration.value_or(0);
    row.maxJointError = scene.settings.maxJointError.value_or(0);
    row.chosen = play(entry, scene, scene.settings, precision);
    for (const int subSteps : kFixed) {
        row.fixed = play(entry, withFixed(scene, subSteps), scene.settings, precision);
        if (row.fixed.error <= 1) {
            row.fixedSubSteps = subSteps;
            break;
        }
    }
    row.chosenSeconds = row.fixedSeconds = std::numeric_limits<double>::infinity();
    const SceneDescription fixed = withFixed(scene, row.fixedSubSteps > 0 ? row.fixedSubSteps : kFixed.back());
    for (int i = 0; i < settings.repeats; ++i) {
        row.chosenSeconds = std::min(row.chosenSeconds, secondsOf(entry, scene, precision));
        row.fixedSeconds = std::min(row.fixedSeconds, secondsOf(entry, fixed, precision));
    }
    return row;
}

std::vector<EffortRow> benchEffort(const EffortBenchSettings& settings,
                                   const std::function<void(const EffortRow&)>& watch) {
    std::vector<EffortRow> rows;
    for (const EffortScene& scene : effortScenes()) {
        for (const Precision precision : {Precision::f32, Precision::f64}) {
            rows.push_back(effortRow(scene, precision, settings));
            watch(rows.back());
        }
    }
    return rows;
}

void writeEffortTable(std::ostream& out, const std::vector<EffortRow>& rows) {
    out << "| scene | budget | error with it, of the budget | missed | smallest fixed sub-steps that keep it | their "
           "error | cost, sub-steps | cost, time |\n"
           "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const EffortRow& row : rows) {
        out << "| " << row.scene << (row.precision == Precision::f32 ? " f32" : " f64") << " | " << budgetText(row)
            << " | " << roundedText(row.chosen.error, 2) << " | " << roundedText(row.chosen.missed) << " | "
            << (row.fixedSubSteps > 0 ? std::to_string(row.fixedSubSteps) : "none up to 64") << " | "
            << roundedText(row.fixed.error, 2) << " | " << ratioText(row.chosen.bodySubSteps, row.fixed.bodySubSteps)
            << " | " << ratioText(row.chosenSeconds, row.fixedSeconds) << " |\n";
    }
}

void writeEffortCsv(std::ostream& csv, const std::vector<EffortRow>& rows) {
    csv << "scene,precision,max_penetration,max_joint_error,penetration,joint_error,missed,bodies_again,"
           "body_sub_steps,seconds,fixed_sub_steps,fixed_penetration,fixed_joint_error,fixed_body_sub_steps,"
           "fixed_seconds\n";
    for (const EffortRow& row : rows) {
        csv << row.scene << ',' << (row.precision == Precision::f32 ? "f32" : "f64");
        for (const double value : {row.maxPenetration, row.maxJointError, row.chosen.penetration, row.chosen.jointError,
                                   row.chosen.missed, row.chosen.bodiesAgain, row.chosen.bodySubSteps,
                                   row.chosenSeconds, static_cast<double>(row.fixedSubSteps), row.fixed.penetration,
                                   row.fixed.jointError, row.fixed.bodySubSteps, row.fixedSeconds}) {
            std::string text;
            appendNumber(text, value);
            csv << ',' << text;
        }
        csv << '\n';
    }
}

}  // namespace swept::bench
