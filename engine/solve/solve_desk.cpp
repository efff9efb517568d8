#include "solve_desk.h"

#include "../counter_list.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

void clearDesk(WorldState& world, SolveDesk& desk) {
    world.contactEvents.insert(world.contactEvents.end(), desk.events.begin(), desk.events.end());
    desk.events.clear();
    addPart(world.counters, desk.counters);
    desk.counters = {};
    world.anyFlung = world.anyFlung || desk.anyFlung;
    desk.anyFlung = false;
}

}  // namespace swept::inline SWEPT_PRECISION
