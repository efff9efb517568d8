#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Marks islands whose contacts were solved all at once, and which are in balance (balance.h) but pushed by forces for
/// this step alone: to go on as they are needs no search and no small steps: `Effort::isSettled`, the cheapest effort
/// there is. As soon as something is no longer so, the island is solved all at once again. (What nothing pushes is not
/// solved at all: held_islands.h.)
/// @pre `findBalancedIslands` found some
void markSettledIslands(WorldState& world);

/// Lets islands that only hinges hold, and that hang still, make do with an eighth of the sub-steps. Still is what
/// hardly moves, and what the forces of the hinges in the last step balance: a pendulum that turns back is not.
/// @pre the efforts of the islands, without this, are in `WorldState::islandLoads`
void slowHangingIslands(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
