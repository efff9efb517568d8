#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Seconds, roughly, that one thread takes for what others may take part in, of a step with these counts.
double workOf(const StepCounters& counters);
/// Calls `pipeline` with `world.loops` set to where its parallel loops run: on the threads of the task system when a
/// step like the last one gains by them, else on the calling thread.
/// @param work  `workOf` the last step; not asked for where there is but one thread
void shareStep(WorldState& world, double work, FunctionRef<void()> pipeline);

}  // namespace swept::inline SWEPT_PRECISION
