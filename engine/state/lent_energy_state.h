#pragma once

#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What goes on from step to step of a chain whose joints only hold, J: the kinetic energy that a jerk took from it as
/// it opened its joints, and that may come back as they close (lent_energy.h), and what it gained that nothing gave
/// (chain_balance.h).
struct LentEnergy {
    double energy = 0;
    double gained = 0;       ///< less than 0: lost
    std::uint64_t step = 0;  ///< `WorldState::steps` of the last solve that it was noted in
};

}  // namespace swept::inline SWEPT_PRECISION
