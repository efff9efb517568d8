#include "accuracy_bench.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../bench/stopwatch.h"
#include "../reference/box2d_runner.h"

namespace swept::accuracy {
namespace {

Contestant ours(const std::string& name, Precision precision, SceneProfile profile) {
    const auto make = [precision, profile](SceneDescription scene, std::string& error) {
        scene.settings.profile = profile;
        RunnerOptions options;
        options.precision = precision;
        return makeRunner(scene, options, error);
    };
    return {name, make, true};
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
    const auto box2d = [](const SceneDescription& scene, std::string& error) -> std::unique_ptr<Runner> {
        return makeBox2dRunner(scene, error);
    };
    return {ours("accurate f32", Precision::f32, SceneProfile::accurate),
            ours("accurate f64", Precision::f64, SceneProfile::accurate),
            ours("fast f32", Precision::f32, SceneProfile::fast), Contestant{"Box2D 2.4.1", box2d, false}};
}

Row measure(const Case& c, const Contestant& contestant) {
    Row row;
    row.group = c.group;
    row.scene = c.name;
    row.contestant = contestant.name;
    row.hertz = 1 / c.scene.settings.dt;
    row.subSteps = c.scene.settings.subSteps.value_or(0);
    const std::unique_ptr<Runner> runner = contestant.make(c.scene, row.verdict);
    if (!runner) {
        return row;
    }
    Frames frames;
    const double seconds = runAll(*runner, c.steps, frames);
    if (contestant.inProcess) {
        row.microseconds = 1e6 * seconds / (static_cast<double>(c.steps) * c.scene.settings.dt);
    }
    if (const auto* const child = dynamic_cast<const Box2dRunner*>(runner.get()); child && child->aborted()) {
        row.verdict = "aborted";
        return row;
    }
    if (!isFinite(frames.back())) {
        row.verdict = "not finite";
        return row;
    }
    for (const Measure& m : c.measures) {
        row.values.push_back({m.name, m.unit, m.of(frames)});
    }
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
