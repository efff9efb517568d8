#pragma once

#include <array>
#include <cstdint>

#include "body.h"
#include "no_index.h"

namespace swept::inline SWEPT_PRECISION {

/// What a solve changes of a body, and whoever takes a solve back therefore has to restore.
struct BodyOutcome {
    BodyMotion motion{};
    Vec2 groundNormal{};  ///< see `Body`: of the step before, until a solve overwrites it
    std::uint32_t ground = kNoIndex;
    bool flung = false;
    bool sunk = false;  ///< not by the solve, but by sweeps over the way that it found
};

/// Likewise, of a contact.
struct ContactOutcome {
    std::uint32_t contact = 0;  ///< index
    std::array<Real, 2> normalImpulse{};
    std::array<Real, 2> tangentImpulse{};
    std::array<Real, 2> totalImpulse{};
    bool pressed = false;
    bool pressedOn = false;
};

}  // namespace swept::inline SWEPT_PRECISION
