#include "report_json.h"

#include <array>
#include <cinttypes>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <utility>

#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>

namespace swept {
namespace {

ReportJson pairOf(DVec2 v) { return ReportJson::array({v.x, v.y}); }

template <class T>
void setIfGiven(ReportJson& object, const char* key, const std::optional<T>& value) {
    if (value) { object[key] = *value; }
}

/// A count without a decimal point, as long as it is one and exact.
ReportJson countOf(double value) {
    constexpr double kExact = 9007199254740992.0;  // 2^53
    if (std::trunc(value) == value && std::abs(value) <= kExact) { return static_cast<std::int64_t>(value); }
    return value;
}

ReportJson lostTimeOf(const SceneDescription& scene, const RunReport& report) {
    ReportJson list = ReportJson::array();
    for (const LostTime& lost : report.lostTime) {
        ReportJson entry;
        entry["body"] = bodyName(scene, static_cast<std::size_t>(lost.body));
        entry["seconds"] = lost.seconds;
        entry["reason"] = lost.reason;
        list.push_back(std::move(entry));
    }
    return list;
}

ReportJson placeOf(const SceneDescription& scene, const DeepestPair& pair) {
    ReportJson json;
    json["time"] = pair.time;
    json["bodies"] = ReportJson::array(
        {bodyName(scene, static_cast<std::size_t>(pair.a)), bodyName(scene, static_cast<std::size_t>(pair.b))});
    return json;
}

ReportJson placeOf(const SceneDescription& scene, const WorstJoint& worst) {
    ReportJson json;
    json["time"] = worst.time;
    json["joint"] = worst.joint;
    json["name"] = jointName(scene, static_cast<std::size_t>(worst.joint));
    return json;
}

/// Sixteen digits: as a JSON number most readers would round it.
std::string hexOf(std::uint64_t value) {
    std::array<char, 17> digits{};
    std::snprintf(digits.data(), digits.size(), "%016" PRIx64, value);
    return digits.data();
}

}  // namespace

ReportJson headOf(const SceneDescription& scene, const RunFacts& facts) {
    const double dt = scene.settings.dt;
    ReportJson json;
    json["scene"] = scene.name;
    if (!facts.source.empty()) { json["source"] = facts.source; }
    json["engine"] = facts.engine;
    if (!facts.precision.empty()) { json["precision"] = facts.precision; }
    if (!facts.steps) { return json; }
    json["steps"] = *facts.steps;
    json["time"] = static_cast<double>(*facts.steps) * dt;
    if (facts.from > 0) { json["from"] = static_cast<double>(facts.from) * dt; }
    return json;
}

void addTotals(ReportJson& json, const SceneDescription& scene, const RunReport& report, std::int64_t steps) {
    json["finite"] = report.finite;
    json["counters"] = ReportJson::object();
    for (const NamedNumber& counter : report.counters) { json["counters"][counter.name] = countOf(counter.value); }
    json["countersSummedOverSteps"] = steps;
    json["lostTime"] = lostTimeOf(scene, report);
    if (const auto most = mostLostTime(report)) {
        json["mostLostTime"] =
            ReportJson{{"body", bodyName(scene, static_cast<std::size_t>(most->body))}, {"seconds", most->seconds}};
    }
    json["deepestPenetration"] = report.deepestPenetration;
    if (report.deepestPair) { json["deepestPenetrationAt"] = placeOf(scene, *report.deepestPair); }
    json["largestJointError"] = report.largestJointError;
    if (report.worstJoint) { json["largestJointErrorAt"] = placeOf(scene, *report.worstJoint); }
    json["energy"] = ReportJson{{"start", report.startEnergy}, {"end", report.endEnergy}};
    json["momentum"] = ReportJson{{"start", pairOf(report.startMomentum)}, {"end", pairOf(report.endMomentum)}};
    json["angularMomentum"] = ReportJson{{"start", report.startAngularMomentum}, {"end", report.endAngularMomentum}};
    if (report.stateHash) { json["stateHash"] = hexOf(*report.stateHash); }
}

ReportJson settingsJson(const SettingsDescription& settings) {
    ReportJson json;
    json["dt"] = settings.dt;
    json["profile"] = namesOf<SceneProfile>()[static_cast<std::size_t>(settings.profile)];
    setIfGiven(json, "subSteps", settings.subSteps);
    setIfGiven(json, "relaxPasses", settings.relaxPasses);
    json["continuous"] = namesOf<SceneContinuous>()[static_cast<std::size_t>(settings.continuous)];
    json["maxImpacts"] = settings.maxImpacts;
    setIfGiven(json, "maxSpeed", settings.maxSpeed);
    json["sleep"] = settings.sleep;
    json["sleepSpeed"] = settings.sleepSpeed;
    json["broadphase"] = namesOf<SceneBroadphase>()[static_cast<std::size_t>(settings.broadphase)];
    setIfGiven(json, "toiTolerance", settings.toiTolerance);
    setIfGiven(json, "maxPenetration", settings.maxPenetration);
    setIfGiven(json, "maxJointError", settings.maxJointError);
    setIfGiven(json, "maxLostTime", settings.maxLostTime);
    return json;
}

std::string jsonText(const ReportJson& json) {
    return json.dump(2, ' ', false, ReportJson::error_handler_t::replace) + '\n';
}

}  // namespace swept
