#include "accuracy_bench.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../bench/stopwatch.h"
#include "../reference/box2d_runner.h"
#include "../reference/peer_limits.h"

namespace swept::accuracy {
namespace {

// With so many sub-steps the stiff Box2D 3 is what its careful user gets.
constexpr int kStiffSubSteps = 16;

Contestant ours(const std::string& name, Precision precision, SceneProfile profile) {
    const auto make = [precision, profile](SceneDescription scene, std::string& error) {
        scene.settings.profile = profile;
        RunnerOptions options;
        options.precision = precision;
        return makeRunner(scene, options, error);
    };
    return {name, make};
}

/// Another engine. Sub-steps that a case asks for are passes of its solver where it has none.
Contestant peer(const std::string& name, const PeerSettings& usual) {
    const auto make = [usual](const SceneDescription& scene, std::string& error) -> std::unique_ptr<Runner> {
        PeerSettings settings = usual;
        if (scene.settings.subSteps) {
            settings.subSteps = settings.solverPasses = *scene.settings.subSteps;
            settings.iterations = iterationsOf(*scene.settings.subSteps);
        }
        return makePeerRunner(scene, settings, error);
    };
    return {name, make};
}

bool isFinite(const Frame& frame) {
    return std::all_of(frame.bodies.begin(), frame.bodies.end(), [](const BodyFrame& body) {
        return std::isfinite(body.position.x) && std::isfinite(body.position.y) && std::isfinite(body.angle);
    });
}

/// Runs to the end or to the first state that is not finite.
double runAll(Runner& runner, std::int64_t steps, Frames& frames) {
    double seconds = 0;
    frames.resize(static_cast<std::size_t>(steps) + 1);
    runner.read(frames[0], false);
    for (std::int64_t i = 1; i <= steps; ++i) {
        const bench::Stopwatch watch;
        runner.step();
        seconds += watch.seconds();
        Frame& frame = frames[static_cast<std::size_t>(i)];
        runner.read(frame, false);
        if (!isFinite(frame)) {
            frames.resize(static_cast<std::size_t>(i) + 1);
            break;
        }
    }
    return seconds;
}

}  // namespace

std::vector<Contestant> allContestants() {
    std::vector<Contestant> contestants{ours("accurate f32", Precision::f32, SceneProfile::accurate),
                                        ours("accurate f64", Precision::f64, SceneProfile::accurate),
                                        ours("fast f32", Precision::f32, SceneProfile::fast), peer("Box2D 2.4.1", {})};
    if (hasPeer(PeerEngine::box2d3)) {
        PeerSettings settings;
        settings.engine = PeerEngine::box2d3;
        contestants.push_back(peer("Box2D 3", settings));
        settings.subSteps = kStiffSubSteps;
        settings.isStiff = 1;
        contestants.push_back(peer("Box2D 3 stiff", settings));
    }
    if (hasPeer(PeerEngine::chipmunk)) {
        PeerSettings settings;
        settings.engine = PeerEngine::chipmunk;
        contestants.push_back(peer("Chipmunk 7", settings));
    }
    return contestants;
}

Row measure(const Case& c, const Contestant& contestant) {
    Row row;
    row.group = c.group;
    row.scene = c.name;
    row.contestant = contestant.name;
    row.hertz = 1 / c.scene.settings.dt;
    row.subSteps = c.scene.settings.subSteps.value_or(0);
    const std::unique_ptr<Runner> runner = contestant.make(c.scene, row.refusal);
    if (!runner) {
        row.verdict = "-";
        return row;
    }
    Frames frames;
    const double seconds = runAll(*runner, c.steps, frames);
    const auto* const child = dynamic_cast<const PeerRunner*>(runner.get());
    row.microseconds = 1e6 * (child != nullptr ? child->stepSeconds() : seconds) /
                       (static_cast<double>(c.steps) * c.scene.settings.dt);
    if (child != nullptr && child->aborted()) {
        row.verdict = "aborted";
        return row;
    }
    if (!isFinite(frames.back())) {
        row.verdict = "not finite";
        return row;
    }
    for (const Measure& m : c.measures) { row.values.push_back({m.name, m.unit, m.of(frames)}); }
    row.verdict = c.verdict ? c.verdict(frames) : "";
    return row;
}

Case refined(const Case& c, double hertz, int subSteps) {
    Case finer = c;
    finer.steps = std::lround(static_cast<double>(c.steps) * c.scene.settings.dt * hertz);
    finer.scene.settings.dt = 1 / hertz;
    finer.scene.settings.subSteps = subSteps;
    return finer;
}

std::vector<Case> tradeCases() {
    constexpr std::array<const char*, 7> kNames{"pendulum-90", "double-pendulum", "chain-R100", "stack-50",
                                                "arch",        "pyramid-20",      "drop-10.3"};
    std::vector<Case> cases;
    for (Case& c : allCases()) {
        if (std::find(kNames.begin(), kNames.end(), c.name) != kNames.end()) {
            c.measures.resize(1);
            cases.push_back(std::move(c));
        }
    }
    return cases;
}

}  // namespace swept::accuracy
