#include "solve_desk.h"

#include <algorithm>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of what solves count.
void addTo(StepCounters& sum, const StepCounters& some) {
    sum.manifolds += some.manifolds;
    sum.sweeps += some.sweeps;
    sum.constraints += some.constraints;
    sum.colours = std::max(sum.colours, some.colours);
    sum.subSteps += some.subSteps;
    sum.bounceRounds += some.bounceRounds;
    sum.bodySubSteps += some.bodySubSteps;
    sum.effortClasses += some.effortClasses;
    sum.mostSubSteps = std::max(sum.mostSubSteps, some.mostSubSteps);
    sum.directBodies += some.directBodies;
    sum.settledBodies += some.settledBodies;
    sum.factorisations += some.factorisations;
    sum.directRounds += some.directRounds;
    sum.directGivenUp += some.directGivenUp;
    sum.speedsLimited += some.speedsLimited;
}

}  // namespace

void clearDesk(WorldState& world, SolveDesk& desk) {
    world.contactEvents.insert(world.contactEvents.end(), desk.events.begin(), desk.events.end());
    desk.events.clear();
    addTo(world.counters, desk.counters);
    desk.counters = {};
    world.anyFlung = world.anyFlung || desk.anyFlung;
    desk.anyFlung = false;
}

}  // namespace swept::inline SWEPT_PRECISION
