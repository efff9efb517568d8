#include "recording.h"

#include "../reference/box2d_runner.h"
#include "../writers/finite_state.h"

namespace swept::measures {
namespace {

/// @return whether the state is finite
bool takeSample(const Runner& runner, const Pace& pace, std::int64_t tick, Recording& recording) {
    Frame frame;
    runner.read(frame, false);
    const RunReport report = runner.report();
    const bool isFinite = !firstNotFinite(frame).has_value();
    recording.samples.push_back({tick, static_cast<double>(tick) * pace.tickTime, std::move(frame.bodies),
                                 report.endEnergy, report.endMomentum});
    return isFinite;
}

}  // namespace

Recording record(Runner& runner, const Pace& pace) {
    Recording recording;
    recording.tickTime = pace.tickTime;
    takeSample(runner, pace, 0, recording);
    const auto* const child = dynamic_cast<const Box2dRunner*>(&runner);
    for (std::int64_t tick = pace.ticksPerStep; tick <= pace.ticks; tick += pace.ticksPerStep) {
        for (int i = 0; i < pace.stepsPerTick; ++i) { runner.step(); }
        if (child != nullptr && child->aborted()) {
            recording.verdict = "aborted";
            break;
        }
        if (!takeSample(runner, pace, tick, recording)) {
            recording.verdict = "not finite";
            break;
        }
    }
    recording.report = runner.report();
    return recording;
}

}  // namespace swept::measures
