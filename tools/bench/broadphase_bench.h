#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "broadphase_contestant.h"
#include "broadphase_scenes.h"

namespace swept::bench {

/// Name of what a world takes if it is not told otherwise.
inline constexpr const char* kDefaultBroadphase = "automatic";

struct BroadphaseBenchSettings {
    std::vector<std::uint32_t> counts = {100, 1000, 10'000};  ///< proxies, ascending
    std::vector<std::string> kinds;                           ///< names of contestants; empty: all
    std::vector<std::string> scenes;                          ///< names of scenes; empty: all
    std::uint64_t seed = 1;
    double secondsPerCase = 0.05;  ///< so long about each contestant is timed on each trace
};

/// One contestant on one trace. Times are of the fastest of several passes, step by step, in nanoseconds.
struct BroadphaseRow {
    std::string scene;
    std::string method;
    std::uint32_t proxies = 0;  ///< most at the same time
    double movedPerStep = 0;    ///< boxes renewed
    double moveTime = 0;        ///< handing over, per renewed box
    double pairTime = 0;        ///< finding pairs, per renewed box
    double buildTime = 0;       ///< inserting all and finding their pairs, per proxy
    double newPairs = 0;        ///< per step, filtered
    double alivePairs = 0;      ///< pairs of overlapping boxes
    double falseShare = 0;      ///< of these, pairs whose bounds do not overlap
    double boxTests = 0;        ///< per renewed box; 0: not told
    double bytes = 0;           ///< per proxy
    double boxQueryTime = 0;
    double rayTime = 0;
    double boxHits = 0;  ///< per query
    double rayHits = 0;
    int passes = 0;
    bool agrees = true;  ///< finds what the default finds

    double time() const { return moveTime + pairTime; }
    double stepTime() const { return time() * movedPerStep; }
    /// Pairs alive looked after in a second of pair finding.
    double newPairsPerSecond() const { return stepTime() > 0 ? 1e9 * newPairs / stepTime() : 0; }
};

/// Called between the rows.
using BroadphaseProgress = std::function<void(const std::string& what)>;

/// All contestants on one trace, pass by pass in turns. No rows of those that take seconds for a pass.
/// @param secondsPerCase  see `BroadphaseBenchSettings`
std::vector<BroadphaseRow> benchTrace(const BroadphaseContestants& contestants, const Motion& motion,
                                      const BoxTrace& trace, double secondsPerCase);

/// Distributions in all sizes. Contestants that would take seconds a step are left out of larger sizes.
std::vector<BroadphaseRow> benchDistributions(const BroadphaseBenchSettings& settings,
                                              const BroadphaseProgress& progress);

/// The eight benchmark scenes of Box2D 3, as our own world plays them.
std::vector<BroadphaseRow> benchPeerScenes(const BroadphaseBenchSettings& settings, const BroadphaseProgress& progress);

bool isWanted(const std::string& name, std::span<const std::string> names);

}  // namespace swept::bench
