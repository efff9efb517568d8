#pragma once

#include "../state/advancing_island.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Before a part of the step: an island whose joints are solved exactly, since nothing touched it as the step began,
/// and that something kinematic leads, is iterated for the rest of the step once it has met ground. What is solved
/// exactly gives way to nothing, nor do contacts that are found on the way: where they contradict each other, one of
/// them throws (of 20 boxes on a hinge of a carrier at 40 m/s, one left the wall at 1400 m/s).
void yieldToGround(WorldState& world, const AdvancingIsland& island);

}  // namespace swept::inline SWEPT_PRECISION
