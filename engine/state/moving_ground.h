#pragma once

#include <cstdint>
#include <vector>

#include "body.h"

namespace swept::inline SWEPT_PRECISION {

/// Awake kinematic bodies of a step in which islands advance. Kept for its capacity.
struct MovingGround {
    std::vector<std::uint32_t> slots;   ///< in order of waking
    std::vector<std::uint32_t> places;  ///< by body slot: in `slots`, of those that are named there
    std::vector<BodyMotion> atStart;    ///< of the step; by place, as the next one
    std::vector<std::uint8_t> isMet;    ///< by the island that advances
    std::vector<std::uint32_t> met;     ///< places of those

    bool holds(std::uint32_t slot) const { return places[slot] < slots.size() && slots[places[slot]] == slot; }
};

}  // namespace swept::inline SWEPT_PRECISION
