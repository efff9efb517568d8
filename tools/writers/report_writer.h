#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <swept/samples/frame.h>
#include <swept/samples/scene_description.h>

namespace swept {

/// What a report says of the run besides the engine's own totals.
struct RunFacts {
    std::string engine;                 ///< "swept2d 0.1.0"
    std::string precision;              ///< "f32", "f64"; empty: not told
    std::optional<std::int64_t> steps;  ///< that were run; nothing: none was
    std::int64_t from = 0;              ///< the steps before are not reported
    std::string source{};               ///< where the scene comes from, as typed; empty: not told
};

/// The body that lost most time in a run, for all reasons together.
struct MostLostTime {
    int body = 0;
    double seconds = 0;
};
/// Nothing where none lost any.
std::optional<MostLostTime> mostLostTime(const RunReport& report);

/// The report of a run as one JSON object: what ran, counters, lost time per body with its reason, deepest penetration,
/// largest joint error, energy and momentum at start and end, budgets and whether they were kept, settings used.
/// A number that is not finite is `null`. The same run gives the same bytes: no clock is in it. Ends with a line feed.
std::string reportText(const SceneDescription& scene, const RunReport& report, const RunFacts& facts);

}  // namespace swept
