#include <algorithm>
#include <cmath>
#include <limits>

#include "../reference/peer_runner.h"
#include "row.h"

namespace swept::envelope {
namespace {

/// Where the scene asks for no sub-steps: what Box2D 2.4.1 advises, and as many of Box2D 3 as ours has, since its error
/// falls with them.
constexpr int kIterationsOfPeer = 8;
constexpr int kSubStepsOfPeer = 16;

std::unique_ptr<Runner> makeRunnerOf(const SceneDescription& scene, tune::Engine engine, std::string& error) {
    if (!tune::isOurs(engine)) {
        const int usual = engine == tune::Engine::box2d3 ? kSubStepsOfPeer : kIterationsOfPeer;
        const int effort = scene.settings.subSteps.value_or(usual);
        return makePeerRunner(scene, tune::peerSettingsOf(engine, effort), error);
    }
    RunnerOptions options;
    options.precision = engine == tune::Engine::f64 ? Precision::f64 : Precision::f32;
    return makeRunner(scene, options, error);
}

bool isFinite(const Frame& frame) {
    return std::all_of(frame.bodies.begin(), frame.bodies.end(), [](const BodyFrame& body) {
        return std::isfinite(body.position.x) && std::isfinite(body.position.y) && std::isfinite(body.angle);
    });
}

/// @return the largest error of the run; `verdict` when it has none
double runTrial(const Trial& trial, tune::Engine engine, std::string& verdict) {
    const std::unique_ptr<Runner> runner = makeRunnerOf(trial.scene, engine, verdict);
    if (!runner) { return 0; }
    const auto* const child = dynamic_cast<const PeerRunner*>(runner.get());
    double worst = 0;
    bool arrived = !trial.hasArrived;
    Frame frame;
    for (std::int64_t i = 0; i < trial.steps; ++i) {
        runner->step();
        runner->read(frame, false);
        if (child != nullptr && child->aborted()) {
            verdict = "aborted";
            return 0;
        }
        if (!isFinite(frame)) {
            verdict = "not finite";
            return 0;
        }
        worst = std::max(worst, trial.error(frame));
        arrived = arrived || trial.hasArrived(frame);
    }
    verdict = arrived ? "" : "never arrived";
    return worst;
}

}  // namespace

Row runCell(const Slice& slice, double x, double y, tune::Engine engine) {
    Row row{x, y, engine, 0, ""};
    for (const Trial& trial : slice.trials(x, y)) {
        std::string verdict;
        row.value = std::max(row.value, runTrial(trial, engine, verdict));
        if (!verdict.empty()) {
            row.verdict = verdict;
            row.value = std::numeric_limits<double>::infinity();
            break;
        }
    }
    return row;
}

}  // namespace swept::envelope
