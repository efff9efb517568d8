#pragma once

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of an island while it advances (`AdvancingIsland::held`): those that it began the step with, and those
/// with ground that it finds on its way, since it leaves the boxes of the start of the step.

/// Manifolds of all of them, and of what comes within reach in this part of the step, where the bodies are now.
void collideHeld(WorldState& world, SolveDesk& desk, double time);

/// Makes the impulses that contacts start from those of sub-steps of another length, seconds. What a contact carries
/// grows with that length, what an impact gives does not: longer sub-steps start from no more than there was in the
/// last one, or at the start of the step. (They did: an impact in an eighth of the usual sub-step came back eight times
/// as strong, and a pile of 21 gained a quarter of all energy in one step; test Energy.NeverGrowsUnderGravity.)
void setSubStep(const WorldState& world, AdvancingIsland& island, double seconds);

/// Before a part is solved: what contacts gave in the parts before is put aside; after it, both are added up.
void putTotalsAside(AdvancingIsland& island);
void addUpTotals(AdvancingIsland& island);

/// After the step: the contacts of the world are what they became here.
void storeHeld(WorldState& world, const AdvancingIsland& island);

}  // namespace swept::inline SWEPT_PRECISION
