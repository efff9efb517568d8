#pragma once

#include <cstdint>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Of the bodies of `WorldState::tied`, into `tiedRoots`. @return how many islands these are
std::uint64_t findRoots(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
