#include "broadphase_bench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "broadphase_peer_scenes.h"
#include "stopwatch.h"

namespace swept::bench {
namespace {

constexpr int kFewestPasses = 2;
constexpr int kMostPasses = 12;
// Patience with a pass, in seconds: a second, or so much for each box and step. What compares all with all exceeds it,
// a tree does not.
constexpr double kShortPass = 1;
constexpr double kTooLongPerBox = 5e-6;
constexpr double kNano = 1e9;

/// The fastest that each step was done by one contestant.
struct Entry {
    BroadphaseContestant* contestant = nullptr;
    std::vector<double> moveSeconds;  // one per step
    std::vector<double> pairSeconds;
    std::vector<std::uint64_t> boxTests;
    double boxQuerySeconds = std::numeric_limits<double>::infinity();
    double raySeconds = std::numeric_limits<double>::infinity();
    std::uint64_t boxHits = 0;
    std::uint64_t rayHits = 0;
    double spent = 0;
    int passes = 0;
    bool agrees = true;
    bool isGivenUp = false;  // took too long
};

std::uint64_t hashOf(const std::vector<TracePair>& pairs) {
    std::uint64_t hash = 0;
    for (const TracePair& pair : pairs) { hash += pairHash(pair); }
    return hash;
}

double tooLong(std::size_t boxes, std::size_t steps) {
    return std::max(kShortPass, kTooLongPerBox * static_cast<double>(boxes * steps));
}

void askQueries(Entry& entry, const SceneQueries& queries) {
    const Stopwatch boxes;
    entry.boxHits = entry.contestant->countBoxHits(queries.boxes);
    entry.boxQuerySeconds = std::min(entry.boxQuerySeconds, boxes.seconds());
    const Stopwatch rays;
    entry.rayHits = entry.contestant->countRayHits(queries.rays);
    entry.raySeconds = std::min(entry.raySeconds, rays.seconds());
}

void replay(Entry& entry, const BoxTrace& trace, const TraceTruth& truth, const SceneQueries& queries) {
    const Stopwatch whole;
    BroadphaseContestant& contestant = *entry.contestant;
    const double patience = tooLong(trace.proxies.size(), trace.steps.size());
    std::vector<TracePair> found;
    contestant.begin(trace.proxies);
    for (std::size_t i = 0; i < trace.steps.size(); ++i) {
        const Stopwatch move;
        contestant.follow(trace.steps[i]);
        entry.moveSeconds[i] = std::min(entry.moveSeconds[i], move.seconds());
        const std::uint64_t testsBefore = contestant.boxTests();
        const Stopwatch pairs;
        contestant.findPairs(found);
        entry.pairSeconds[i] = std::min(entry.pairSeconds[i], pairs.seconds());
        entry.boxTests[i] = contestant.boxTests() - testsBefore;
        contestant.forget(truth.ended[i]);
        entry.agrees = entry.agrees && found.size() == truth.found[i] && hashOf(found) == truth.hashes[i];
        if (whole.seconds() > patience && i + 1 < trace.steps.size()) {
            entry.isGivenUp = true;
            return;
        }
    }
    askQueries(entry, queries);
    entry.spent += whole.seconds();
    ++entry.passes;
}

template <class T>
double sumFrom(const std::vector<T>& values, std::size_t first) {
    double sum = 0;
    for (std::size_t i = first; i < values.size(); ++i) { sum += static_cast<double>(values[i]); }
    return sum;
}

std::uint32_t mostProxies(const BoxTrace& trace) {
    std::uint32_t present = 0;
    std::uint32_t most = 0;
    for (const TraceStep& step : trace.steps) {
        present += static_cast<std::uint32_t>(step.inserted.size());
        present -= static_cast<std::uint32_t>(step.removed.size());
        most = std::max(most, present);
    }
    return most;
}

BroadphaseRow rowOf(const Entry& entry, const BoxTrace& trace, const TraceTruth& truth, const SceneQueries& queries) {
    const auto steps = static_cast<double>(trace.steps.size() - trace.warmSteps);
    const double moves = std::max(1.0, static_cast<double>(trace.timedMoves()));
    const auto asked = static_cast<double>(queries.boxes.size());
    BroadphaseRow row;
    row.scene = trace.name;
    row.method = entry.contestant->name();
    row.proxies = mostProxies(trace);
    row.movedPerStep = moves / steps;
    row.moveTime = kNano * sumFrom(entry.moveSeconds, trace.warmSteps) / moves;
    row.pairTime = kNano * sumFrom(entry.pairSeconds, trace.warmSteps) / moves;
    row.buildTime = kNano * (entry.moveSeconds[0] + entry.pairSeconds[0]) /
                    std::max(1.0, static_cast<double>(trace.steps[0].inserted.size()));
    row.newPairs = sumFrom(truth.found, trace.warmSteps) / steps;
    row.alivePairs = truth.meanAlive;
    row.falseShare = truth.meanAlive > 0 ? truth.meanFalse / truth.meanAlive : 0;
    row.boxTests = sumFrom(entry.boxTests, trace.warmSteps) / moves;
    row.bytes = static_cast<double>(entry.contestant->memoryBytes()) / row.proxies;
    row.boxQueryTime = kNano * entry.boxQuerySeconds / asked;
    row.rayTime = kNano * entry.raySeconds / asked;
    row.boxHits = static_cast<double>(entry.boxHits) / asked;
    row.rayHits = static_cast<double>(entry.rayHits) / asked;
    row.passes = entry.passes;
    row.agrees = entry.agrees;
    return row;
}

Entry entryFor(BroadphaseContestant& contestant, std::size_t steps) {
    Entry entry;
    entry.contestant = &contestant;
    entry.moveSeconds.assign(steps, std::numeric_limits<double>::infinity());
    entry.pairSeconds.assign(steps, std::numeric_limits<double>::infinity());
    entry.boxTests.assign(steps, 0);
    return entry;
}

int stepsFor(std::uint32_t count) { return static_cast<int>(std::clamp(60'000U / count, 4U, 60U)); }

/// Who takes too long with ten times as many, going by the last two sizes.
class Patience {
public:
    bool mayRun(const std::string& scene, const std::string& method, std::uint32_t count) const {
        const auto found = last_.find({scene, method});
        if (found == last_.end()) { return true; }
        const Seen& seen = found->second;
        const double growth = std::pow(static_cast<double>(count) / seen.count, seen.exponent);
        const int steps = stepsFor(count);
        return seen.seconds * growth * steps < tooLong(count, static_cast<std::size_t>(steps));
    }
    /// @param seconds  of one step
    void note(const BroadphaseRow& row, std::uint32_t count) {
        const double seconds = row.stepTime() / kNano;
        Seen seen{count, seconds, 1};
        const auto before = last_.find({row.scene, row.method});
        if (before != last_.end() && before->second.seconds > 0) {
            seen.exponent = std::log(seconds / before->second.seconds) /
                            std::log(static_cast<double>(count) / before->second.count);
        }
        last_[{row.scene, row.method}] = seen;
    }

private:
    struct Seen {
        std::uint32_t count;
        double seconds;
        double exponent;
    };
    std::map<std::pair<std::string, std::string>, Seen> last_;
};

}  // namespace

bool isWanted(const std::string& name, std::span<const std::string> names) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<BroadphaseRow> benchTrace(const BroadphaseContestants& contestants, const Motion& motion,
                                      const BoxTrace& trace, double secondsPerCase) {
    constexpr int kQueries = 500;
    const TraceTruth truth = truthOf(motion, trace);
    const SceneQueries queries = queriesFor(trace, kQueries, 1);
    std::vector<Entry> entries;
    for (const auto& contestant : contestants) { entries.push_back(entryFor(*contestant, trace.steps.size())); }
    for (int pass = 0; pass < kMostPasses; ++pass) {
        for (Entry& entry : entries) {
            if (!entry.isGivenUp && (pass < kFewestPasses || entry.spent < secondsPerCase)) {
                replay(entry, trace, truth, queries);
            }
        }
    }
    std::vector<BroadphaseRow> rows;
    for (const Entry& entry : entries) {
        if (!entry.isGivenUp) { rows.push_back(rowOf(entry, trace, truth, queries)); }
    }
    return rows;
}

std::vector<BroadphaseRow> benchDistributions(const BroadphaseBenchSettings& settings,
                                              const BroadphaseProgress& progress) {
    std::vector<BroadphaseRow> rows;
    Patience patience;
    for (const BoxScene scene : kBoxScenes) {
        if (!isWanted(nameOf(scene), settings.scenes)) { continue; }
        for (const std::uint32_t count : settings.counts) {
            progress(std::string(nameOf(scene)) + ' ' + std::to_string(count));
            const int steps = stepsFor(count);
            const int warmSteps = std::max(2, steps / 4);
            const Motion motion = makeBoxScene(scene, count, steps + warmSteps, settings.seed);
            BoxTrace trace = enlarged(motion, {});
            trace.warmSteps = 1 + static_cast<std::size_t>(warmSteps);
            BroadphaseContestants contestants = allBroadphases(settings.kinds);
            std::erase_if(contestants,
                          [&](const auto& one) { return !patience.mayRun(nameOf(scene), one->name(), count); });
            for (const BroadphaseRow& row : benchTrace(contestants, motion, trace, settings.secondsPerCase)) {
                patience.note(row, count);
                rows.push_back(row);
            }
        }
    }
    return rows;
}

std::vector<BroadphaseRow> benchPeerScenes(const BroadphaseBenchSettings& settings,
                                           const BroadphaseProgress& progress) {
    std::vector<BroadphaseRow> rows;
    for (const PeerScene scene : kPeerScenes) {
        if (!isWanted(nameOf(scene), settings.scenes)) { continue; }
        progress(nameOf(scene));
        const RecordedScene recorded = recordPeerScene(scene);
        BoxTrace trace = enlarged(recorded.motion, {.asBox2d3 = true});
        trace.warmSteps = recorded.warmSteps;
        const auto found = benchTrace(allBroadphases(settings.kinds), recorded.motion, trace, settings.secondsPerCase);
        rows.insert(rows.end(), found.begin(), found.end());
    }
    return rows;
}

}  // namespace swept::bench
