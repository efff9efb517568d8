#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Most islands with something fast get through their step in one part, without an impact. So that is tried first, for
/// all of them together with everything else that is solved: a solve of its own costs a small island several times what
/// it has to solve, above all one with joints, of which each colour holds few. Those that do meet something are put
/// back, and advance on their own (island_advance.h).

/// Chooses the islands, whose members take part in the coming solve, and remembers what that changes.
/// @pre those that bounced off each other in flight are done
void beginFirstTry(WorldState& world, double dt);
/// After that solve: members have the role `together` again; islands that met something are as they were before it.
/// `FastIslands::meets` tells which.
/// @pre each worker has its scratch
void judgeFirstTry(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
