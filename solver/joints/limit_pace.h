#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// Speeds of the two limits of a joint, m/s or rad/s.
struct LimitPace {
    Real lower = 0;
    Real upper = 0;

    constexpr bool any() const { return lower != 0 || upper != 0; }
};

/// How limits move by themselves within a step, and with them what they hold.
struct LimitMotion {
    LimitPace glide;
    /// What that keeps of it as its speed: what relaxation asks for instead of rest. Where a limit glides without it,
    /// what stands on its bodies stays behind.
    LimitPace pace;

    /// What a pass of the solver asks for.
    constexpr const LimitPace& asked(bool useBias) const { return useBias ? glide : pace; }
};

}  // namespace swept::inline SWEPT_PRECISION
