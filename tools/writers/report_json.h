#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json.hpp>

#include <swept/samples/frame.h>
#include <swept/samples/scene_description.h>

#include "report_writer.h"

/// The parts of which all commands make what they write as JSON, so that the same thing has the same key in each.

namespace swept {

/// A JSON value whose members keep the order in which they were made.
using ReportJson = nlohmann::ordered_json;

/// What ran: `scene`, `source`, `engine`, `precision`, `steps`, `time`, `from`, of those that there are.
ReportJson headOf(const SceneDescription& scene, const RunFacts& facts);

/// What came out of a run: `finite`, `counters`, `lostTime`, `deepestPenetration` … `stateHash`.
/// @param steps  of which counters are the sums
void addTotals(ReportJson& json, const SceneDescription& scene, const RunReport& report, std::int64_t steps);

/// As used, with the keys of the scene format; optional ones only where given.
ReportJson settingsJson(const SettingsDescription& settings);

/// To be read by people, too. A number that is not finite is `null`. Ends with a line feed.
std::string jsonText(const ReportJson& json);

}  // namespace swept
