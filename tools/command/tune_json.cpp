#include "tune_json.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "../bench/machine.h"
#include "../writers/report_json.h"
#include "commands.h"

namespace swept {
namespace {

ReportJson tuneHead(const TuneQuestion& question) {
    ReportJson json = headOf(question.subject.scene, question.facts);
    json["machine"] = bench::machineText();
    json["reference"] = question.known.reference;
    json["accepted"] = ReportJson::array();
    for (const tune::Limit& limit : question.limits) {
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        ReportJson entry{
            {"measure", info.name}, {"unit", info.unit}, {"limit", limit.value}, {"implied", limit.implied}};
        if (info.needsReference) { entry["uncertainty"] = question.known.uncertainty[limit.measure]; }
        json["accepted"].push_back(std::move(entry));
    }
    return json;
}

/// Those that say something of the scene.
ReportJson errorsJson(const measures::Values& errors) {
    ReportJson json = ReportJson::object();
    for (const measures::MeasureInfo& info : measures::allMeasures()) {
        const double error = errors[*measures::measureNamed(info.name)];
        if (!std::isnan(error)) { json[info.name] = error; }
    }
    return json;
}

/// With the keys of the scene format.
ReportJson configJson(const TuneQuestion& question, const tune::Config& config) {
    const ReportJson all = settingsJson(tune::withConfig(question.subject.scene, config).settings);
    ReportJson json;
    for (const char* const key : {"dt", "subSteps", "relaxPasses", "continuous", "toiTolerance", "broadphase"}) {
        const bool isTheirs = std::string(key) == "dt" || std::string(key) == "subSteps";
        if (all.contains(key) && (isOurs(config.engine) || isTheirs)) { json[key] = all[key]; }
    }
    return json;
}

/// What a run cost and how far it was off; of one that failed, why.
void addOutcome(ReportJson& json, const TuneQuestion& question, const tune::Row& row) {
    if (!row.verdict.empty()) {
        json["failed"] = row.verdict;
        return;
    }
    json["cost"] = row.cost;
    json["errors"] = errorsJson(row.errors);
    json["ofAccepted"] = tune::strain(row, question.limits, question.known.uncertainty);
}

ReportJson tuneRowJson(const TuneQuestion& question, const tune::Row& row) {
    const bool isOurs = tune::isOurs(row.config.engine);
    ReportJson json;
    json["engine"] = isOurs ? "swept2d " + versionText() : tune::nameOf(row.config.engine);
    if (isOurs) { json["precision"] = tune::nameOf(row.config.engine); }
    json["settings"] = configJson(question, row.config);
    addOutcome(json, question, row);
    return json;
}

}  // namespace

std::string adviceJson(const TuneQuestion& question, const tune::Verdict& verdict, const std::string& tuned) {
    const std::vector<tune::Row>& rows = question.known.rows;
    const auto rowAt = [&](int row) { return tuneRowJson(question, rows[static_cast<std::size_t>(row)]); };
    ReportJson json = tuneHead(question);
    if (verdict.recommended >= 0) {
        json["recommended"] = rowAt(verdict.recommended);
        json["tuned"] = tuned;
    } else {
        json["recommended"] = nullptr;
        if (verdict.nearest >= 0) { json["nearest"] = rowAt(verdict.nearest); }
    }
    const tune::Config own = tune::ownConfig(question.subject.scene);
    json["rows"] = ReportJson::array();
    for (const std::size_t i : verdict.order) {
        ReportJson row = tuneRowJson(question, rows[i]);
        row["own"] = rows[i].config == own;
        row["front"] = std::find(verdict.front.begin(), verdict.front.end(), i) != verdict.front.end();
        json["rows"].push_back(std::move(row));
    }
    return jsonText(json);
}

std::string ablationJson(const TuneQuestion& question, const tune::Ablation& ablation, const std::string& lean) {
    ReportJson json = tuneHead(question);
    json["visible"] = ablation.visible;
    addOutcome(json["whole"], question, ablation.whole);
    json["features"] = ReportJson::array();
    for (const tune::Ablated& one : ablation.single) {
        ReportJson entry{{"feature", one.features.front()}, {"present", one.isPresent}};
        if (one.isPresent && one.refusal.empty()) {
            entry["needed"] = one.isNeeded;
            entry["change"] = one.change;
            addOutcome(entry, question, one.row);
        }
        if (!one.refusal.empty()) { entry["failed"] = one.refusal; }
        json["features"].push_back(std::move(entry));
    }
    if (!ablation.isDecided) { return jsonText(json); }
    json["leanest"]["without"] = ablation.lean.features;
    if (!ablation.lean.features.empty()) { addOutcome(json["leanest"], question, ablation.lean.row); }
    json["lean"] = lean;
    return jsonText(json);
}

}  // namespace swept
