#include "report_writer.h"

#include <map>
#include <optional>
#include <utility>

#include "report_json.h"

namespace swept {
namespace {

void addBudget(ReportJson& budgets, const char* name, const std::optional<double>& limit, double value) {
    if (!limit) { return; }
    ReportJson entry;
    entry["limit"] = *limit;
    entry["value"] = value;
    entry["kept"] = value <= *limit;
    budgets[name] = std::move(entry);
}

ReportJson budgetsOf(const SettingsDescription& settings, const RunReport& report) {
    const std::optional<MostLostTime> most = mostLostTime(report);
    ReportJson budgets = ReportJson::object();
    addBudget(budgets, "maxPenetration", settings.maxPenetration, report.deepestPenetration);
    addBudget(budgets, "maxJointError", settings.maxJointError, report.largestJointError);
    addBudget(budgets, "maxLostTime", settings.maxLostTime, most ? most->seconds : 0);
    return budgets;
}

}  // namespace

std::optional<MostLostTime> mostLostTime(const RunReport& report) {
    std::map<int, double> sums;
    for (const LostTime& lost : report.lostTime) { sums[lost.body] += lost.seconds; }
    std::optional<MostLostTime> most;
    for (const auto& [body, seconds] : sums) {
        if (seconds > (most ? most->seconds : 0)) { most = MostLostTime{body, seconds}; }
    }
    return most;
}

std::string reportText(const SceneDescription& scene, const RunReport& report, const RunFacts& facts) {
    ReportJson json = headOf(scene, facts);
    addTotals(json, scene, report, facts.steps.value_or(facts.from) - facts.from);
    json["budgets"] = budgetsOf(scene.settings, report);
    json["gravity"] = ReportJson::array({scene.gravity.x, scene.gravity.y});
    json["settings"] = settingsJson(scene.settings);
    return jsonText(json);
}

}  // namespace swept
