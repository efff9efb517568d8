#include "search.h"

#include <algorithm>
#include <array>
#include <limits>

#include "../inspect/inspect_scene.h"
#include "../measures/scene_size.h"

namespace swept::tune {
namespace {

/// Sub-steps that are tried.
constexpr std::array<int, 7> kSubSteps{1, 2, 4, 8, 16, 32, 64};
constexpr std::array<int, 4> kRelaxPasses{0, 1, 2, 4};
/// Velocity iterations of Box2D; 8 is what its manual advises.
constexpr std::array<int, 3> kBox2dIterations{4, 8, 32};
/// Sub-steps of Box2D 3; 4 is what its manual advises.
constexpr std::array<int, 3> kBox2d3SubSteps{4, 16, 64};
/// Steps, as powers of two times the scene's.
constexpr std::array<int, 4> kSteps{0, 1, -1, -2};
/// Multiples of the tolerance by extent; four times is the target itself, where the certificate ends.
constexpr std::array<double, 2> kTolerances{2, 4};
constexpr double kToleranceByExtent = 1.0 / 4096;

/// What was learned about a set of settings.
struct Known {
    bool ran = false;
    bool holds = false;
    double work = 0;
};

class TrackSearch {
public:
    TrackSearch(const Track& track, const Subject& subject, const std::vector<Limit>& limits, const Knowledge& known)
        : limits_(limits), known_(known), start_(ownConfig(subject.scene)) {
        start_.engine = track.engine;
        start_.dtPower = track.dtPower;
    }

    std::vector<Config> next(const SearchSpace& space) const {
        if (!isOurs(start_.engine)) {
            return ofPeer(start_.engine == Engine::box2d3 ? kBox2d3SubSteps : kBox2dIterations);
        }
        std::vector<Config> wanted;
        if (start_.dtPower == 0) {
            want(start_, wanted);  // what the scene has now
        }
        Config base = start_;
        if (!bisect(base, wanted) || start_.engine == Engine::f64) { return wanted; }
        const std::vector<std::vector<Config>> changes = changesOf(base, space);
        for (const std::vector<Config>& change : changes) {
            for (const Config& config : change) { want(config, wanted); }
        }
        if (wanted.empty()) { want(together(base, changes), wanted); }
        return wanted;
    }

private:
    Known knownOf(const Config& config) const {
        const Row* const row = known_.find(config);
        return row == nullptr ? Known{} : Known{true, holds(strain(*row, limits_, known_.uncertainty)), row->work};
    }

    void want(const Config& config, std::vector<Config>& wanted) const {
        if (!knownOf(config).ran && std::find(wanted.begin(), wanted.end(), config) == wanted.end()) {
            wanted.push_back(config);
        }
    }

    std::vector<Config> ofPeer(const std::array<int, 3>& efforts) const {
        std::vector<Config> wanted;
        for (const int effort : efforts) {
            Config config = start_;
            config.subSteps = effort;
            want(config, wanted);
        }
        return wanted;
    }

    /// Leaves the fewest sub-steps that hold in `base`, as far as they follow from what is known.
    /// @return whether that is settled and any hold; else `wanted` has what to run
    bool bisect(Config& base, std::vector<Config>& wanted) const {
        std::size_t lowest = 0;
        std::size_t highest = kSubSteps.size();  // this one is taken to hold
        while (lowest < highest) {
            const std::size_t middle = (lowest + highest) / 2;
            base.subSteps = kSubSteps[middle];
            const Known found = knownOf(base);
            if (!found.ran) {
                want(base, wanted);
                return false;
            }
            (found.holds ? highest : lowest) = found.holds ? middle : middle + 1;
        }
        if (highest == kSubSteps.size()) { return false; }
        base.subSteps = kSubSteps[highest];
        return true;
    }

    /// One list for each kind of change.
    static std::vector<std::vector<Config>> changesOf(const Config& base, const SearchSpace& space) {
        std::vector<std::vector<Config>> changes(3);
        for (const int passes : kRelaxPasses) {
            changes[0].push_back(base);
            changes[0].back().relaxPasses = passes;
        }
        for (const SceneContinuous mode : space.modes) {
            changes[1].push_back(base);
            changes[1].back().continuous = mode;
        }
        for (const double tolerance : space.toiTolerances) {
            changes[2].push_back(base);
            changes[2].back().toiTolerance = tolerance;
        }
        return changes;
    }

    /// Of each kind the change that holds with the least work, all at once. What saves next to nothing is left as it
    /// is: a weaker mode, or a coarser tolerance, is not to be had for that.
    Config together(const Config& base, const std::vector<std::vector<Config>>& changes) const {
        Config best = base;
        for (const std::vector<Config>& change : changes) {
            double least = knownOf(base).work / kWorkNoise;
            for (const Config& config : change) {
                const Known found = knownOf(config);
                if (!found.holds || found.work >= least) { continue; }
                least = found.work;
                if (config.relaxPasses != base.relaxPasses) { best.relaxPasses = config.relaxPasses; }
                if (config.continuous != base.continuous) { best.continuous = config.continuous; }
                if (config.toiTolerance != base.toiTolerance) { best.toiTolerance = config.toiTolerance; }
            }
        }
        return best;
    }

    const std::vector<Limit>& limits_;
    const Knowledge& known_;
    Config start_;
};

}  // namespace

SearchSpace searchSpaceOf(const SceneDescription& scene) {
    SearchSpace space;
    for (const SceneBroadphase kind :
         {SceneBroadphase::allPairs, SceneBroadphase::sortAndSweep, SceneBroadphase::grid, SceneBroadphase::wideBvh}) {
        if (kind != scene.settings.broadphase) { space.broadphases.push_back(kind); }
    }
    const Inspection inspection = inspectScene(scene);
    const bool isFast = std::any_of(inspection.needs.begin(), inspection.needs.end(), [](const Need& need) {
        return need.feature == "continuous collision" && need.needed;
    });
    for (const SceneContinuous mode : {SceneContinuous::off, SceneContinuous::speedLimit, SceneContinuous::speculative,
                                       SceneContinuous::stop, SceneContinuous::subStep}) {
        const bool matters = isFast || mode == SceneContinuous::off;
        if (matters && mode != scene.settings.continuous) { space.modes.push_back(mode); }
    }
    const double extent = measures::smallestExtent(scene);
    for (const double multiple : kTolerances) {
        if (isFast) { space.toiTolerances.push_back(multiple * kToleranceByExtent * extent); }
    }
    return space;
}

std::vector<Track> allTracks() {
    std::vector<Track> tracks;
    for (const Engine engine : {Engine::f32, Engine::box2d, Engine::box2d3, Engine::f64}) {
        for (const int power : kSteps) {
            if (isThere(engine)) { tracks.push_back({engine, power}); }
        }
    }
    return tracks;
}

std::vector<Config> nextOf(const Track& track, const Subject& subject, const SearchSpace& space,
                           const std::vector<Limit>& limits, const Knowledge& known) {
    return TrackSearch(track, subject, limits, known).next(space);
}

std::vector<Config> lastOf(const Subject& subject, const SearchSpace& space, const std::vector<Limit>& limits,
                           const Knowledge& known) {
    const SceneBroadphase own = subject.scene.settings.broadphase;
    std::vector<const Row*> keeping;
    double least = std::numeric_limits<double>::infinity();
    for (const Row& row : known.rows) {
        if (isOurs(row.config.engine) && row.config.broadphase == own &&
            holds(strain(row, limits, known.uncertainty))) {
            keeping.push_back(&row);
            least = std::min(least, row.work);
        }
    }
    const Row* best = nullptr;
    for (const Row* const row : keeping) {
        if (row->work > kWorkNoise * least) { continue; }
        const bool isFirst = best == nullptr || isStronger(row->config.continuous, best->config.continuous);
        const bool isCheaper = !isFirst && row->config.continuous == best->config.continuous && row->work < best->work;
        if (isFirst || isCheaper) { best = row; }
    }
    std::vector<Config> wanted;
    for (const SceneBroadphase kind : space.broadphases) {
        if (best != nullptr) {
            Config config = best->config;
            config.broadphase = kind;
            if (known.find(config) == nullptr) { wanted.push_back(config); }
        }
    }
    return wanted;
}

}  // namespace swept::tune
