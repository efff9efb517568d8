#include "reference.h"

#include "../writers/number_text.h"
#include "closed_forms.h"
#include "hits.h"
#include "measure_run.h"
#include "scene_size.h"

namespace swept::measures {
namespace {

constexpr int kMostHalvings = 4;
/// Part of the smallest extent below which a change of place no longer matters.
constexpr double kSettled = 1.0 / 1024;

Reference fromClosedForm(const SceneDescription& scene, const ClosedForm& form, std::int64_t ticks) {
    Reference reference;
    reference.source = "closed form: " + form.name;
    reference.isClosedForm = true;
    reference.recording.tickTime = scene.settings.dt;
    for (std::int64_t tick = 0; tick <= ticks; ++tick) {
        Sample sample{tick, static_cast<double>(tick) * scene.settings.dt, {}, 0, {}};
        for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
            sample.bodies.push_back({form.position(static_cast<int>(body), sample.time), 0, {}, 0, false});
        }
        reference.recording.samples.push_back(std::move(sample));
    }
    for (const MeasureInfo& info : allMeasures()) {
        const Measure measure = *measureNamed(info.name);
        if (info.needsReference && measure != Measure::eventTime) {  // which takes velocities
            reference.uncertainty[measure] = 0;
        }
    }
    reference.uncertainty[Measure::missedHits] = 0;
    return reference;
}

Recording refinedRun(SceneDescription scene, std::int64_t ticks, int halvings) {
    Pace pace{scene.settings.dt, ticks, 1 << halvings, 1};
    scene.settings.dt = pace.dt();
    scene.settings.sleep = false;
    scene.settings.continuous = SceneContinuous::subStep;
    RunnerOptions options;
    options.precision = Precision::f64;
    Recording failed;
    const auto runner = makeRunner(scene, options, failed.verdict);
    return runner ? record(*runner, pace) : failed;
}

}  // namespace

Reference makeReference(const SceneDescription& scene, std::int64_t ticks, const RefinementWatcher& watch) {
    const double duration = static_cast<double>(ticks) * scene.settings.dt;
    if (const auto form = closedFormOf(scene, duration)) { return fromClosedForm(scene, *form, ticks); }
    const double settled = kSettled * smallestExtent(scene);
    Reference reference;
    Recording coarser = refinedRun(scene, ticks, 0);
    for (int halvings = 1; halvings <= kMostHalvings; ++halvings) {
        if (watch) { watch(halvings, kMostHalvings); }
        reference.recording = refinedRun(scene, ticks, halvings);
        reference.dt = scene.settings.dt / (1 << halvings);
        if (!coarser.isComplete() || !reference.recording.isComplete()) { break; }
        reference.uncertainty = measuredAgainst(scene, coarser, reference.recording);
        if (reference.uncertainty[Measure::position] <= settled || halvings == kMostHalvings) { break; }
        coarser = std::move(reference.recording);
    }
    double missed = 0;
    for (const ForeseenHit& hit : foreseenHits(scene, reference.recording)) { missed += hit.missed ? 1 : 0; }
    reference.uncertainty[Measure::missedHits] = missed;
    reference.source = "f64, steps of " + roundedText(1e3 * reference.dt, 3) + " ms";
    return reference;
}

}  // namespace swept::measures
