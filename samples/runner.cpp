#include "runner.h"

#include "world_runners.h"

namespace swept {

std::unique_ptr<Runner> makeRunner(const SceneDescription& scene, const RunnerOptions& options, std::string& error) {
    switch (options.precision) {
        case Precision::f32:
            return f32::makeWorldRunner(scene, options, error);
        case Precision::f64:
            return f64::makeWorldRunner(scene, options, error);
    }
    return nullptr;  // unreachable, but GCC cannot know
}

Trace runTrace(Runner& runner, std::int64_t steps, std::int64_t every, bool withContacts) {
    Trace trace;
    trace.frames.emplace_back();
    runner.read(trace.frames.back(), withContacts);
    for (std::int64_t step = 1; step <= steps; ++step) {
        if (!runner.step()) { break; }
        trace.events.insert(trace.events.end(), runner.events().begin(), runner.events().end());
        if (step % every != 0 && step != steps) { continue; }
        trace.frames.emplace_back();
        runner.read(trace.frames.back(), withContacts);
    }
    trace.report = runner.report();
    return trace;
}

}  // namespace swept
