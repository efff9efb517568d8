#pragma once

#include <cstdint>
#include <limits>

#include "effort.h"

namespace swept::inline SWEPT_PRECISION {

/// What the budgets of an island are compared with, at the start of the step. Kept for its capacity.
struct IslandErrors {
    Real penetration = 0;  ///< the deepest, metres
    Real jointError = 0;   ///< the largest, metres
    Real blow = 0;         ///< how far the fastest blow of this step would go on in it, metres
    Real push = 0;         ///< how far the forces on a member would take it in this step, metres
    bool hasContacts = false;
    bool hasJoints = false;
    // Of the last solve (effort_trial.h).
    std::uint8_t tries = 0;     ///< that were taken back
    Real penetrationAfter = 0;  ///< metres
    Real jointErrorAfter = 0;
    Effort next{};  ///< to be solved with again; else that which it was solved with
    std::int8_t doublings = std::numeric_limits<std::int8_t>::lowest();  ///< largest of a member in the last step
};

}  // namespace swept::inline SWEPT_PRECISION
