#pragma once

#include <cstdint>

#include "../../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// `Body::soughtSteps` of what was held until now: what concerns it takes place, before another balance is sought.
inline constexpr std::uint16_t kJustReleased = 1;

/// What contacts and pulls leave of each other on a body in a step.
struct Pull {
    Vec2 force{};     ///< N·s
    Real torque = 0;  ///< N·s·m
};

/// Of an island, in a step.
struct IslandRest {
    bool isRestless = false;  ///< some member moves, or a joint, a kinematic body, a belt or a force has a part in it
    bool isPushed = false;    ///< by forces for this step alone
    bool isOff = false;       ///< impulses leave something of the pulls, or press where nothing touches
    bool isSought = false;    ///< likewise, and others are sought (load_paths.h)
    bool isDirect = false;    ///< its contacts were solved all at once
    bool isLarge = false;     ///< likewise, in a large web (effort.h)
    std::uint16_t soughtSteps = 0;       ///< largest `Body::soughtSteps`
    std::uint32_t heldIn = 0xFFFFFFFFu;  ///< place in `HeldIslands`, once it has one
};

}  // namespace swept::inline SWEPT_PRECISION
