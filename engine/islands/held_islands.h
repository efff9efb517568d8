#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// An island that is still and in balance (balance.h), and set aside: its bodies keep their poses and stand still, its
/// contacts keep their impulses, and no stage looks at any of them, as if they slept. To the user they are awake.
/// Whatever would wake them, and whatever changes the world they were in balance with, makes them take part again in
/// the very step in which that happens. To hold is to remember what `findBalancedIslands` would find again.
struct HeldIsland {
    std::uint32_t last = 0;  ///< of its bodies, by slot; their ring (`Body::nextAsleep`) goes on with the first
    std::uint32_t bodies = 0;
    std::uint32_t placeInUse = 0;  ///< in `HeldIslands::inUse`
    // What `Body` counts while it is awake, if the world may sleep.
    int restSteps = 0;  ///< since it is held
    double restTime = 0;
    int stepsToSleep = 0;  ///< of the body that needs most
    double timeToSleep = 0;
};

/// Kept for its capacity, and for what the counters say.
struct HeldIslands {
    std::vector<HeldIsland> list;      ///< by `Body::heldIn`; those that are free have no bodies
    std::vector<std::uint32_t> inUse;  ///< places in the list, in no order
    std::vector<std::uint32_t> free;   ///< the others
    std::uint32_t bodies = 0;          ///< of all
};

/// Sets aside the islands for which that is worth its while: those in balance that nothing pushes for this step alone.
/// @pre `findBalancedIslands` found some
void holdBalancedIslands(WorldState& world);
/// All that is held with a body takes part again, in its old order. @pre it is held
void releaseHeld(WorldState& world, std::uint32_t body);
/// What everything was in balance with is no longer so.
void releaseAllHeld(WorldState& world);
/// At the end of a step: what is held counts its rest, and falls asleep when it is time. Nobody sees it but the user.
void restHeld(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
