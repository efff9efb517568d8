#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts of an island while it advances (`AdvancingIsland::contacts`): those that it began the step with, and
/// those with ground that it finds on its way, since it leaves the boxes of the start of the step.

/// Manifolds of all of them, and of what comes within reach in this part of the step, where the bodies are now.
/// @param ground  meets what comes within reach; null: no kinematic body is awake
void collideIslandContacts(WorldState& world, IslandDesk& desk, double time, GroundOnTheWay* ground);

/// Makes the impulses that contacts start from those of sub-steps of another length, seconds. What a contact carries
/// grows with that length, what an impact gives does not: longer sub-steps start from no more than there was in the
/// last one, or at the start of the step. (They did: an impact in an eighth of the usual sub-step came back eight times
/// as strong, and a pile of 21 gained a quarter of all energy in one step; test Energy.NeverGrowsUnderGravity.)
void setSubStep(const WorldState& world, AdvancingIsland& island, double seconds);

/// Before a part is solved: what contacts gave in the parts before is put aside; after it, both are added up.
void putTotalsAside(AdvancingIsland& island);
void addUpTotals(AdvancingIsland& island);

/// Before a part that may be taken back. Those of the first part are still in the world as they were: a large island,
/// which mostly has no other one, need not copy them in vain.
void rememberIslandContacts(AdvancingIsland& island, bool isFirstPart);
/// As they were then.
void takeBackIslandContacts(const WorldState& world, AdvancingIsland& island, bool isFirstPart);

/// After the step: the contacts of the world are what they became here. What pressed in it has points, those with which
/// it did, though they may be out of reach by now: its impulse is told by them. Of contacts that were found on the way,
/// those are left at the desk.
void storeIslandContacts(WorldState& world, IslandDesk& desk);

/// What islands left at their desks becomes part of the world, in an order that does not depend on where they advanced:
/// their impulses are told, and the next step begins with them.
void addFoundContacts(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
