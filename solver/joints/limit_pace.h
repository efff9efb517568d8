#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// How fast the limits of a joint move by themselves within a step, m/s or rad/s: as what they hold is to. A limit that
/// is only put farther draws its bodies there, but leaves them no speed, and what stands on these stays behind.
struct LimitPace {
    Real lower = 0;
    Real upper = 0;

    constexpr bool any() const { return lower != 0 || upper != 0; }
};

}  // namespace swept::inline SWEPT_PRECISION
