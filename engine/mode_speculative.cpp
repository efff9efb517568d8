#include "modes.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {

void reachAhead(WorldState& world) {
    for (const std::uint32_t slot : world.awake) {
        const bool ahead = modeOf(world, world.bodies[slot]) == ContinuousMode::speculative;
        if (ahead) { updateProxies(world, slot, false); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
