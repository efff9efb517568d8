#include "shared_step.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Seconds each, on a machine of 2020, rounded down: what of a step stands in shared loops (`swept bench threads`,
/// on one thread). What one worker must do alone gains nothing, however long it takes: of a heap of 500 bodies that was
/// three fifths of the step, of 2000 bodies in flight a fifth, in twice the time for all.
constexpr double kPerAwakeBody = 1.4e-7;
constexpr double kPerFlyer = 1e-7;  // more than others
constexpr double kPerManifold = 1e-7;
constexpr double kPerToiCall = 5e-7;
constexpr double kPerSolve = 2e-6;
/// Of solves whose colours are shared.
constexpr double kPerConstraint = 1.5e-7;
constexpr double kPerBodySubStep = 3e-8;
/// So many constraints of a colour, in the mean: some colours of a solve that is shared (`Solver`) are small.
constexpr std::uint64_t kFewestPerColour = 224;
/// So many times as long as starting takes is what others may take part in, at least. Two threads save half of that at
/// most: as long as starting takes by what is said of it, which is generous.
constexpr double kWorthStarting = 2;

}  // namespace

double workOf(const StepCounters& counters) {
    // What is solved all at once is not shared: its constraints count with the others', by its bodies.
    const std::uint64_t iterated = counters.solvedBodies - std::min(counters.solvedBodies, counters.directBodies);
    const double share =
        counters.solvedBodies > 0 ? static_cast<double>(iterated) / static_cast<double>(counters.solvedBodies) : 0;
    const bool areColoursShared = counters.constraints >= kFewestPerColour * counters.colours;
    const double ofSolves = kPerConstraint * static_cast<double>(counters.constraints) +
                            kPerBodySubStep * static_cast<double>(counters.bodySubSteps);
    return kPerAwakeBody * static_cast<double>(counters.awakeBodies - counters.settledBodies) +
           kPerFlyer * static_cast<double>(counters.flyers) + kPerManifold * static_cast<double>(counters.manifolds) +
           kPerToiCall * static_cast<double>(counters.toiCalls) +
           kPerSolve * static_cast<double>(counters.effortClasses) + (areColoursShared ? share * ofSolves : 0);
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
