#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Of some awake bodies: what the last step left is forgotten, and how fast each may be in this one is known. While
/// contacts are noticed others may do that. @param awake  slots @pre `traits` were cleared for this step
void resetBodies(WorldState& world, std::span<const std::uint32_t> awake, Real dt);

}  // namespace swept::inline SWEPT_PRECISION
