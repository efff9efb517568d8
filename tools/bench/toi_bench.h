#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "../toi/toi_families.h"
#include "toi_contestant.h"

namespace swept::bench {

/// What a judge found in the answers of one contestant. Lengths in metres.
struct ToiTally {
    int queries = 0;
    int right = 0;
    int missed = 0;
    int late = 0;
    int early = 0;
    int falseOverlap = 0;
    int failed = 0;
    int wrongReport = 0;     ///< a fraction outside of the sweep
    int undecided = 0;       ///< by the oracle
    double deepestMiss = 0;  ///< below target − tolerance
    double deepestLate = 0;
    double widestGap = 0;  ///< of early hits, above target + tolerance

    int deep() const { return missed + late; }
    int wrong() const { return missed + late + early + falseOverlap + failed + wrongReport; }
    void add(const ToiTally& other);
};

/// One contestant on one family.
struct ToiBenchRow {
    std::string family;
    std::string method;
    ToiTally tally;
    std::vector<int> iterations;  ///< of each query, ascending; empty where they are not told
    double nanoseconds = 0;       ///< a query: median of the passes

    /// The smallest number of iterations with which the share of the queries comes to its end; 0 without queries.
    int iterationsOf(double share) const;
};

struct ToiBenchSettings {
    int count = 2000;  ///< queries a family
    std::uint64_t seed = 1;
};

/// Called between the rows with what has been done of all there is to do.
using BenchProgress = std::function<void(int done, int all)>;

/// Every contestant on every family. Contestants take turns, pass by pass, in this process.
std::vector<ToiBenchRow> benchToi(const ToiContestants& contestants, const ToiBenchSettings& settings,
                                  const BenchProgress& progress);

/// One contestant on bodies that both turn by a given angle: the generic family with its turning replaced.
struct TurnPoint {
    std::string method;
    double turn = 0;  ///< of either body, radians in a step
    ToiTally tally;
};

/// Turns from a hundredth of a radian to four full ones.
std::vector<TurnPoint> benchTurns(const ToiContestants& contestants, const ToiBenchSettings& settings,
                                  const BenchProgress& progress);

}  // namespace swept::bench
