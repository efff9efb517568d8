#include "ablation.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "../deviation.h"
#include "../measures/measure_run.h"
#include "run_config.h"
#include "team.h"

namespace swept::tune {
namespace {

const Feature& featureNamed(const std::string& name) {
    const auto features = allFeatures();
    return *std::find_if(features.begin(), features.end(),
                         [&](const Feature& feature) { return feature.name == name; });
}

/// Whether a sensor of the scene has anything to tell within the run.
bool anySensorEvent(const Subject& subject) {
    RunnerOptions options;
    options.collectEvents = true;
    std::string ignored;
    const auto runner = makeRunner(subject.scene, options, ignored);
    for (std::int64_t i = 0; runner && i < subject.ticks; ++i) {
        runner->step();
        const auto isOfSensor = [](const SceneEvent& event) {
            return event.type == SceneEventType::sensorBegin || event.type == SceneEventType::sensorEnd;
        };
        if (std::any_of(runner->events().begin(), runner->events().end(), isOfSensor)) { return true; }
    }
    return false;
}

/// One subject and what its outcome is judged by.
class Bench {
public:
    Bench(const Subject& subject, const std::vector<Limit>& limits, const measures::Reference& reference)
        : subject_(subject),
          limits_(limits),
          reference_(reference),
          visible_(visibleDeviation(subject.scene)),
          whole_(runScene(subject.scene, subject, ownConfig(subject.scene), reference)) {}

    const Row& whole() const { return whole_.row; }
    double visible() const { return visible_; }

    Ablated without(const std::vector<std::string>& features) const {
        Ablated result;
        result.features = features;
        SceneDescription scene = subject_.scene;
        Config config = ownConfig(scene);
        bool isModel = false;
        for (const std::string& name : features) {
            const Feature& feature = featureNamed(name);
            result.isPresent = feature.isPresent(subject_.scene, ownConfig(subject_.scene));
            isModel = isModel || feature.isModel;
            feature.remove(scene, config);
        }
        if (!result.isPresent) { return result; }
        Run run = runScene(scene, subject_, config, reference_);
        result.row = std::move(run.row);
        result.refusal = std::move(run.refusal);
        if (!result.row.verdict.empty()) { return result; }
        result.change = std::fmax(
            0, measures::measuredAgainst(subject_.scene, run.recording, whole_.recording)[measures::Measure::position]);
        const bool isSeen = isModel && result.change > visible_;
        const bool isTold =
            std::find(features.begin(), features.end(), "sensors") != features.end() && anySensorEvent(subject_);
        result.isNeeded = isSeen || isTold || !holds(strain(result.row, limits_, reference_.uncertainty));
        return result;
    }

private:
    const Subject& subject_;
    const std::vector<Limit>& limits_;
    const measures::Reference& reference_;
    double visible_;
    Run whole_;
};

/// What can go and costs nothing to leave out, the most costly first.
std::vector<std::string> candidates(const Ablation& ablation) {
    std::vector<const Ablated*> dispensable;
    for (const Ablated& one : ablation.single) {
        if (one.isPresent && !one.isNeeded && one.row.work <= ablation.whole.work) { dispensable.push_back(&one); }
    }
    std::stable_sort(dispensable.begin(), dispensable.end(),
                     [](const Ablated* a, const Ablated* b) { return a->row.work < b->row.work; });
    std::vector<std::string> names;
    for (const Ablated* const one : dispensable) { names.push_back(one->features.front()); }
    return names;
}

}  // namespace

Ablation ablate(const Subject& subject, const std::vector<Limit>& limits, const measures::Reference& reference,
                int threads, const std::function<void(std::size_t done, std::size_t all)>& watch) {
    const Bench bench(subject, limits, reference);
    Ablation ablation;
    ablation.whole = bench.whole();
    ablation.visible = bench.visible();
    ablation.lean.row = ablation.whole;
    ablation.lean.isNeeded = false;
    ablation.isDecided = holds(strain(ablation.whole, limits, reference.uncertainty));
    if (!ablation.isDecided) { return ablation; }
    const auto features = allFeatures();
    ablation.single.resize(features.size());
    std::mutex mutex;
    std::size_t done = 0;
    runParallel(features.size(), threads, [&](std::size_t i) {
        ablation.single[i] = bench.without({features[i].name});
        const std::lock_guard lock(mutex);
        watch(++done, features.size());
    });
    std::vector<std::string> names = candidates(ablation);
    for (; !names.empty(); names.pop_back()) {  // what is left out together may matter though each alone does not
        Ablated lean = bench.without(names);
        if (!lean.isNeeded) {
            ablation.lean = std::move(lean);
            break;
        }
    }
    return ablation;
}

SceneDescription leanScene(const Subject& subject, const Ablation& ablation) {
    SceneDescription scene = subject.scene;
    Config config = ownConfig(scene);
    for (const std::string& name : ablation.lean.features) { featureNamed(name).remove(scene, config); }
    return withConfig(std::move(scene), config);
}

}  // namespace swept::tune
