#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

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

    /// A new island without bodies. @param body  the first one to come. @return its place in the list
    std::uint32_t open(std::uint32_t body) {
        if (free.empty()) {
            free.push_back(static_cast<std::uint32_t>(list.size()));
            list.emplace_back();
            free.reserve(list.capacity());
        }
        const std::uint32_t place = free.back();
        free.pop_back();
        list[place] = {.last = body, .placeInUse = static_cast<std::uint32_t>(inUse.size())};
        inUse.push_back(place);
        return place;
    }

    void close(std::uint32_t place) {
        bodies -= list[place].bodies;
        const std::uint32_t placeInUse = list[place].placeInUse;
        inUse[placeInUse] = inUse.back();
        list[inUse.back()].placeInUse = placeInUse;
        inUse.pop_back();
        list[place] = {};
        free.push_back(place);
    }
};

}  // namespace swept::inline SWEPT_PRECISION
