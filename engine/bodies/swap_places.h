#pragma once

#include <span>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Where a body was, or is.
struct SwappedPlace {
    std::uint32_t slot;
    DVec2 center;
    double angle;
};

/// Each body goes to its place, and where it is becomes that: twice, and all are where they were, to the bit.
void swapPlaces(WorldState& world, std::span<SwappedPlace> places);

}  // namespace swept::inline SWEPT_PRECISION
