#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <swept/samples/runner.h>

namespace swept::measures {

/// A moment of a run.
struct Sample {
    std::int64_t tick = 0;  ///< in steps of the scene as it was given: runs of other steps meet at equal ticks
    double time = 0;        ///< s
    std::vector<BodyFrame> bodies;
    double energy = 0;  ///< J, kinetic and potential
    DVec2 momentum;     ///< N·s, of the dynamic bodies
};

/// A run as the measures see it, whatever engine made it.
struct Recording {
    double tickTime = 0;  ///< s
    std::vector<Sample> samples;
    RunReport report;
    std::string verdict;  ///< empty when all went well; "not finite", "aborted", or what was refused

    bool isComplete() const { return verdict.empty(); }
    double duration() const { return samples.empty() ? 0 : samples.back().time; }
};

/// How a run is laid out on the ticks: a sample every tick, or every step where steps are longer.
struct Pace {
    double tickTime = 1.0 / 60;  ///< s, the step of the scene as it was given
    std::int64_t ticks = 600;    ///< length of the run
    int stepsPerTick = 1;        ///< for steps that are a part of a tick
    int ticksPerStep = 1;        ///< for steps of several ticks; divides `ticks`

    double dt() const { return tickTime * ticksPerStep / stepsPerTick; }
    std::int64_t steps() const { return ticks * stepsPerTick / ticksPerStep; }
};

/// Runs to the end, or to the first state that is not finite.
/// @param runner  of a scene whose step is `pace.dt()`, at its start
Recording record(Runner& runner, const Pace& pace);

}  // namespace swept::measures
