#include "world_bench.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "../reference/peer_limits.h"

namespace swept::worlds {
namespace {

/// Steps of a turn: so many that the caches are the engine's own again for most of them.
constexpr int kTurn = 20;
/// Fewer where they would take longer than that: what is to be stopped is, and a child that works is not taken for one
/// that hangs.
constexpr double kTurnSeconds = 2;

Contestant ours(const char* name, Precision precision, SceneProfile profile) {
    Contestant contestant{name, {}};
    contestant.request.engine.isOurs = 1;
    contestant.request.engine.precision = precision;
    contestant.request.engine.profile = profile;
    return contestant;
}

Contestant peer(const char* name, PeerEngine engine) {
    Contestant contestant{name, {}};
    contestant.request.engine.peer.engine = engine;
    return contestant;
}

bool isWanted(const std::string& name, const std::vector<std::string>& wanted) {
    return wanted.empty() || std::find(wanted.begin(), wanted.end(), name) != wanted.end();
}

double sumOf(std::span<const StepTime> times) {
    return std::accumulate(times.begin(), times.end(), 0.0,
                           [](double sum, const StepTime& time) { return sum + time.seconds; });
}

using StepRepeats = std::vector<std::vector<StepTime>>;  // of each timed step, a time from each run

/// A run under way.
class Runner {
public:
    Runner(WorldRow& row, const WorldRequest& request, const WorldBenchSettings& settings, int warmSteps,
           int timedSteps)
        : row_(row), settings_(settings), warmSteps_(warmSteps), stepsLeft_(warmSteps + timedSteps) {
        if (!child_.start(request, settings.executable, row_.refusal)) { stop("-"); }
    }

    bool goesOn() const { return stepsLeft_ > 0; }

    /// @param isFirst  of the repeats: measures too
    void takeTurn(bool isFirst) {
        if (isFirst && times_.empty()) { measure(&row_.startEnergy); }
        // The turn ends where the timing begins.
        const auto done = static_cast<int>(times_.size());
        const int most = done < warmSteps_ ? std::min(turn_, warmSteps_ - done) : turn_;
        const int steps = std::min(most, stepsLeft_);
        if (!child_.run(steps, times_)) {
            row_.refusal = child_.finish();
            stop("aborted");
            return;
        }
        stepsLeft_ -= steps;
        const double used = sumOf(std::span<const StepTime>(times_).last(static_cast<std::size_t>(steps)));
        used_ += used;
        turn_ =
            static_cast<int>(std::clamp(kTurnSeconds * steps / std::max(used, kTurnSeconds / kTurn), 1.0, 1.0 * kTurn));
        if (isFirst && done + steps >= warmSteps_) { measure(nullptr); }
        if (used_ > settings_.seconds && stepsLeft_ > 0) { stop("stopped"); }
    }

    /// @param repeats  what each timed step took before; the first run says how many there are, so that a repeat which
    /// is
    ///                 stopped earlier does not shorten what was measured
    void finish(bool isFirst, StepRepeats& repeats) {
        const std::size_t first = std::min(times_.size(), static_cast<std::size_t>(warmSteps_));
        const std::span<const StepTime> timed = std::span<const StepTime>(times_).subspan(first);
        if (isFirst) {
            repeats.resize(timed.size());
            row_.memory = row_.verdict.empty() ? child_.memory() : 0;
        }
        for (std::size_t i = 0; i < std::min(timed.size(), repeats.size()); ++i) { repeats[i].push_back(timed[i]); }
    }

private:
    void stop(const char* verdict) {
        row_.verdict = verdict;
        stepsLeft_ = 0;
    }

    /// @param startEnergy  where to put that of the start; else this is a sample of the timed steps
    void measure(double* startEnergy) {
        Quality quality;
        if (!child_.measure(quality, startEnergy == nullptr)) {
            return;  // the next turn will tell
        }
        if (startEnergy != nullptr) {
            *startEnergy = quality.energy;
        } else {
            row_.quality = quality;
        }
    }

    WorldRow& row_;
    const WorldBenchSettings& settings_;
    int warmSteps_;
    int stepsLeft_;
    WorldChild child_;
    std::vector<StepTime> times_;
    double used_ = 0;
    int turn_ = 1;  // until it is known how long a step takes
};

/// Every contestant that can go on from the start to the end, in turns. @param repeats  one for each row
void runOnce(const BenchScene& bench, const std::vector<Contestant>& contestants, std::vector<WorldRow>& rows,
             std::vector<StepRepeats>& repeats, const WorldBenchSettings& settings, bool isFirst) {
    const int warm = settings.full ? 0 : bench.warmSteps;
    const int timed = settings.full ? bench.fullSteps : settings.steps;
    std::vector<std::unique_ptr<Runner>> runners(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!rows[i].verdict.empty()) {
            continue;  // stopped once, stopped for good: repeating it would take as long again
        }
        WorldRequest request = contestants[i].request;
        rows[i].scene.copy(request.scene.data(), WorldRequest::kNameSize - 1);
        request.size = settings.size;
        runners[i] = std::make_unique<Runner>(rows[i], request, settings, warm, timed);
    }
    for (bool goesOn = true; goesOn;) {
        goesOn = false;
        for (const auto& runner : runners) {
            if (runner && runner->goesOn()) {
                runner->takeTurn(isFirst);
                goesOn = true;
            }
        }
    }
    for (std::size_t i = 0; i < runners.size(); ++i) {
        if (runners[i]) { runners[i]->finish(isFirst, repeats[i]); }
    }
}

}  // namespace

std::vector<Contestant> allContestants() {
    std::vector<Contestant> contestants{ours("fast f32", Precision::f32, SceneProfile::fast),
                                        ours("accurate f32", Precision::f32, SceneProfile::accurate),
                                        ours("fast f64", Precision::f64, SceneProfile::fast),
                                        ours("accurate f64", Precision::f64, SceneProfile::accurate)};
    if (hasPeer(PeerEngine::box2d3)) { contestants.push_back(peer(kRival, PeerEngine::box2d3)); }
    contestants.push_back(peer("Box2D 2.4.1", PeerEngine::box2d2));
    if (hasPeer(PeerEngine::chipmunk)) { contestants.push_back(peer("Chipmunk 7", PeerEngine::chipmunk)); }
    return contestants;
}

double WorldRow::perStep() const { return times.empty() ? 0 : sumOf(times) / static_cast<double>(times.size()); }

double WorldRow::longestStep() const {
    double longest = 0;
    for (const StepTime& time : times) { longest = std::max(longest, time.seconds); }
    return longest;
}

PeerStages WorldRow::stages() const {
    PeerStages sum;
    for (const StepTime& time : times) {
        const PeerStages& s = time.stages;
        const double wall = s.pairs + s.collide + s.islands + s.solve + s.continuous + s.finish;
        const double part = wall > time.seconds ? time.seconds / wall : 1;
        sum.pairs += part * s.pairs;
        sum.collide += part * s.collide;
        sum.islands += part * s.islands;
        sum.solve += part * s.solve;
        sum.continuous += part * s.continuous;
        sum.finish += part * s.finish;
    }
    const double share = times.empty() ? 0 : 1 / static_cast<double>(times.size());
    return {share * sum.pairs, share * sum.collide,    share * sum.islands,
            share * sum.solve, share * sum.continuous, share * sum.finish};
}

StepTime timeOfRepeats(std::vector<StepTime> repeats, Repeats counts) {
    std::sort(repeats.begin(), repeats.end(),
              [](const StepTime& a, const StepTime& b) { return a.seconds < b.seconds; });
    if (counts == Repeats::fastest) { return repeats.front(); }
    const StepTime& low = repeats[(repeats.size() - 1) / 2];
    const StepTime& high = repeats[repeats.size() / 2];
    const auto middle = [&](double PeerStages::*stage) { return (low.stages.*stage + high.stages.*stage) / 2; };
    return {(low.seconds + high.seconds) / 2,
            {middle(&PeerStages::pairs), middle(&PeerStages::collide), middle(&PeerStages::islands),
             middle(&PeerStages::solve), middle(&PeerStages::continuous), middle(&PeerStages::finish)}};
}

double ratioOf(const WorldRow& row, const WorldRow& rival) {
    const std::size_t count = std::min(row.times.size(), rival.times.size());
    const double theirs = sumOf(std::span<const StepTime>(rival.times).first(count));
    return theirs > 0 ? sumOf(std::span<const StepTime>(row.times).first(count)) / theirs : 0;
}

std::vector<WorldRow> benchScene(const SceneEntry& entry, const WorldBenchSettings& settings) {
    const BenchScene bench = entry.make(settings.size);
    std::vector<Contestant> contestants;
    std::vector<WorldRow> rows;
    for (const Contestant& contestant : allContestants()) {
        if (isWanted(contestant.name, settings.engines)) {
            contestants.push_back(contestant);
            WorldRow& row = rows.emplace_back();
            row.scene = entry.name;
            row.contestant = contestant.name;
            row.isPublished = entry.isPublished;
            row.bodies = bench.scene.bodies.size();
            row.joints = bench.scene.joints.size();
        }
    }
    std::vector<StepRepeats> repeats(rows.size());
    for (int repeat = 0; repeat < settings.repeats; ++repeat) {
        runOnce(bench, contestants, rows, repeats, settings, repeat == 0);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (const std::vector<StepTime>& step : repeats[i]) {
            rows[i].times.push_back(timeOfRepeats(step, settings.counts));
        }
    }
    return rows;
}

std::vector<WorldRow> benchWorlds(const WorldBenchSettings& settings,
                                  const std::function<void(const std::vector<WorldRow>&)>& progress) {
    std::vector<WorldRow> rows;
    for (const SceneEntry& entry : allScenes()) {
        if (isWanted(entry.name, settings.scenes)) {
            for (WorldRow& row : benchScene(entry, settings)) { rows.push_back(std::move(row)); }
            progress(rows);
        }
    }
    return rows;
}

}  // namespace swept::worlds
