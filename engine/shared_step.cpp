#include "shared_step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Seconds each, on a machine of 2020, rounded down (`swept bench threads`): a step is handed over when that pays, not
/// sooner.
constexpr double kPerAwakeBody = 2e-7;
constexpr double kPerManifold = 1.5e-7;
constexpr double kPerConstraint = 1.5e-7;
constexpr double kPerBodySubStep = 3e-8;
constexpr double kPerToiCall = 5e-7;
constexpr double kPerSolve = 2e-6;
/// So many times as long as starting it takes is what a step must last on one thread.
constexpr double kWorthStarting = 6;

}  // namespace

double workOf(const StepCounters& counters) {
    return kPerAwakeBody * static_cast<double>(counters.awakeBodies - counters.settledBodies) +
           kPerManifold * static_cast<double>(counters.manifolds) +
           kPerConstraint * static_cast<double>(counters.constraints) +
           kPerBodySubStep * static_cast<double>(counters.bodySubSteps) +
           kPerToiCall * static_cast<double>(counters.toiCalls) +
           kPerSolve * static_cast<double>(counters.effortClasses);
}

void shareStep(WorldState& world, double work, FunctionRef<void()> pipeline) {
    TaskSystem& tasks = *world.userTasks;
    const double start = tasks.startSeconds();
    if (tasks.workerCount() <= 1 || work < kWorthStarting * start) {
        world.loops = &world.serialTasks;
        pipeline();
    } else if (start <= 0) {
        world.loops = &tasks;
        pipeline();
    } else {
        world.loops = &world.crew;
        world.crew.lead(tasks, pipeline);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
