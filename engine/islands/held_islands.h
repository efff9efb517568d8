#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Sets aside the islands for which that is worth its while: those in balance that nothing pushes for this step alone.
/// @pre `findBalancedIslands` found some
void holdBalancedIslands(WorldState& world);
/// At the end of a step: what is held counts its rest, and falls asleep when it is time. Nobody sees it but the user.
void restHeld(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
