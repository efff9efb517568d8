#pragma once

#include <cstdint>

namespace swept::inline SWEPT_PRECISION {

/// The kinetic energy that a jerk took from a chain as it opened its joints, and that may come back as they close
/// (lent_energy.h).
struct LentEnergy {
    double energy = 0;       ///< J
    std::uint64_t step = 0;  ///< `WorldState::steps` of the last solve that it was noted in
};

}  // namespace swept::inline SWEPT_PRECISION
