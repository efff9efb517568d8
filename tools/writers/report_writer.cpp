#include "report_writer.h"

#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>
#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace swept {
namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(SceneContinuous mode) {
    switch (mode) {
        case SceneContinuous::off:
            return "off";
        case SceneContinuous::speedLimit:
            return "speedLimit";
        case SceneContinuous::speculative:
            return "speculative";
        case SceneContinuous::stop:
            return "stop";
        case SceneContinuous::subStep:
            return "subStep";
    }
    return "";  // unreachable, but GCC cannot know
}

Json pairOf(DVec2 v) { return Json::array({v.x, v.y}); }

template <class T>
void setIfGiven(Json& object, const char* key, const std::optional<T>& value) {
    if (value) { object[key] = *value; }
}

/// A count without a decimal point, as long as it is one and exact.
Json countOf(double value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (std::trunc(value) == value && std::abs(value) <= kExact) { return static_cast<std::int64_t>(value); }
    return value;
}

Json settingsOf(const SettingsDescription& settings) {
    Json json;
    json["dt"] = settings.dt;
    json["profile"] = settings.profile == SceneProfile::fast ? "fast" : "accurate";
    setIfGiven(json, "subSteps", settings.subSteps);
    setIfGiven(json, "relaxPasses", settings.relaxPasses);
    json["continuous"] = nameOf(settings.continuous);
    json["maxImpacts"] = settings.maxImpacts;
    setIfGiven(json, "maxSpeed", settings.maxSpeed);
    json["sleep"] = settings.sleep;
    json["broadphase"] = namesOf<SceneBroadphase>()[static_cast<std::size_t>(settings.broadphase)];
    setIfGiven(json, "toiTolerance", settings.toiTolerance);
    setIfGiven(json, "maxPenetration", settings.maxPenetration);
    setIfGiven(json, "maxJointError", settings.maxJointError);
    setIfGiven(json, "maxLostTime", settings.maxLostTime);
    return json;
}

Json lostTimeOf(const SceneDescription& scene, const RunReport& report) {
    Json list = Json::array();
    for (const LostTime& lost : report.lostTime) {
        Json entry;
        entry["body"] = bodyName(scene, static_cast<std::size_t>(lost.body));
        entry["seconds"] = lost.seconds;
        entry["reason"] = lost.reason;
        list.push_back(std::move(entry));
    }
    return list;
}

Json placeOf(const SceneDescription& scene, const DeepestPair& pair) {
    Json json;
    json["time"] = pair.time;
    json["bodies"] = Json::array(
        {bodyName(scene, static_cast<std::size_t>(pair.a)), bodyName(scene, static_cast<std::size_t>(pair.b))});
    return json;
}

Json placeOf(const SceneDescription& scene, const WorstJoint& worst) {
    Json json;
    json["time"] = worst.time;
    json["joint"] = worst.joint;
    json["name"] = jointName(scene, static_cast<std::size_t>(worst.joint));
    return json;
}

void addBudget(Json& budgets, const char* name, const std::optional<double>& limit, double value) {
    if (!limit) { return; }
    Json entry;
    entry["limit"] = *limit;
    entry["value"] = value;
    entry["kept"] = value <= *limit;
    budgets[name] = std::move(entry);
}

Json budgetsOf(const SettingsDescription& settings, const RunReport& report) {
    const std::optional<MostLostTime> most = mostLostTime(report);
    Json budgets = Json::object();
    addBudget(budgets, "maxPenetration", settings.maxPenetration, report.deepestPenetration);
    addBudget(budgets, "maxJointError", settings.maxJointError, report.largestJointError);
    addBudget(budgets, "maxLostTime", settings.maxLostTime, most ? most->seconds : 0);
    return budgets;
}

/// Sixteen digits: as a JSON number most readers would round it.
std::string hexOf(std::uint64_t value) {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016" PRIx64, value);
    return digits.data();
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
    Json json;
    json["scene"] = scene.name;
    json["engine"] = facts.engine;
    json["precision"] = facts.precision;
    json["steps"] = facts.steps;
    json["time"] = static_cast<double>(facts.steps) * scene.settings.dt;
    json["finite"] = report.finite;
    json["counters"] = Json::object();
    for (const NamedNumber& counter : report.counters) { json["counters"][counter.name] = countOf(counter.value); }
    json["lostTime"] = lostTimeOf(scene, report);
    if (const auto most = mostLostTime(report)) {
        json["mostLostTime"] =
            Json{{"body", bodyName(scene, static_cast<std::size_t>(most->body))}, {"seconds", most->seconds}};
    }
    json["deepestPenetration"] = report.deepestPenetration;
    if (report.deepestPair) { json["deepestPenetrationAt"] = placeOf(scene, *report.deepestPair); }
    json["largestJointError"] = report.largestJointError;
    if (report.worstJoint) { json["largestJointErrorAt"] = placeOf(scene, *report.worstJoint); }
    json["energy"] = Json{{"start", report.startEnergy}, {"end", report.endEnergy}};
    json["momentum"] = Json{{"start", pairOf(report.startMomentum)}, {"end", pairOf(report.endMomentum)}};
    json["angularMomentum"] = Json{{"start", report.startAngularMomentum}, {"end", report.endAngularMomentum}};
    if (report.stateHash) { json["stateHash"] = hexOf(*report.stateHash); }
    json["budgets"] = budgetsOf(scene.settings, report);
    json["gravity"] = pairOf(scene.gravity);
    json["settings"] = settingsOf(scene.settings);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace swept
