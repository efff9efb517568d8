#include "run_config.h"

#include "../bench/run_time.h"
#include "../measures/measure_run.h"
#include "../reference/peer_runner.h"

namespace swept::tune {
namespace {

std::unique_ptr<Runner> makeRunnerOf(const SceneDescription& given, const Config& config, bool measure,
                                     std::string& error) {
    const SceneDescription scene = withConfig(given, config);
    if (!isOurs(config.engine)) { return makePeerRunner(scene, peerSettingsOf(config.engine, config.subSteps), error); }
    RunnerOptions options;
    options.precision = config.engine == Engine::f64 ? Precision::f64 : Precision::f32;
    options.measure = measure;
    return makeRunner(scene, options, error);
}

/// Processor time of all steps, s.
double secondsOf(const SceneDescription& scene, const Config& config, std::int64_t steps) {
    const auto make = [&] {
        std::string ignored;  // the run that measured was not refused
        return makeRunnerOf(scene, config, false, ignored);
    };
    return bench::fastestRun(make, steps);
}

/// A child measures outside its steps, so that its one run tells its cost as well.
double secondsOfChild(const Runner& runner) {
    const auto* const child = dynamic_cast<const PeerRunner*>(&runner);
    return child != nullptr ? child->stepSeconds() : 0;
}

double counted(const RunReport& report, const char* name) {
    for (const NamedNumber& counter : report.counters) {
        if (counter.name == name) { return counter.value; }
    }
    return 0;
}

/// Nanoseconds, roughly, as `swept_bench_kernels` has them for one of each: good enough to tell a cheaper setting from
/// a dearer one, and the same on every machine.
double workOf(const RunReport& report, const Config& config, double duration) {
    constexpr double kPass = 10;
    constexpr double kManifold = 80;
    constexpr double kToi = 400;
    constexpr double kBody = 60;
    constexpr double kBoxTest = 2;
    const double passes = static_cast<double>(config.subSteps) * (2 + config.relaxPasses);
    const double total = kPass * counted(report, "constraints") * passes + kManifold * counted(report, "manifolds") +
                         kToi * counted(report, "toiCalls") + kBody * counted(report, "awakeBodies") +
                         kBoxTest * counted(report, "boxTests");
    return 1e-9 * total / duration;
}

}  // namespace

Run runScene(const SceneDescription& scene, const Subject& subject, const Config& config,
             const measures::Reference& reference) {
    Run run;
    Row& row = run.row;
    row.config = config;
    const auto runner = makeRunnerOf(scene, config, true, run.refusal);
    if (!runner) {
        row.verdict = "refused";
        return run;
    }
    const measures::Pace pace = paceOf(subject.scene, config, subject.ticks);
    run.recording = measures::record(*runner, pace);
    row.verdict = run.recording.verdict;
    if (!run.recording.isComplete()) { return run; }
    row.errors = measures::measured(subject.scene, run.recording, reference);
    row.work = workOf(run.recording.report, config, run.recording.duration());
    const double seconds = isOurs(config.engine) ? secondsOf(scene, config, pace.steps()) : secondsOfChild(*runner);
    row.cost = seconds / run.recording.duration();
    return run;
}

Row runConfig(const Subject& subject, const Config& config, const measures::Reference& reference) {
    return runScene(subject.scene, subject, config, reference).row;
}

}  // namespace swept::tune
