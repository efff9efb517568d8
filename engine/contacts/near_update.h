#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

/// Manifolds of contacts that are near: what a step spends most of its stage of contacts on.

namespace swept::inline SWEPT_PRECISION {

/// Of all that is listed as near (`ContactLists::near`). Several workers take parts of them.
void updateNear(WorldState& world);
/// Of probes that were told to pass each other: their manifolds, with whatever points are within reach.
void collideHemmed(WorldState& world, std::span<const std::uint32_t> probes);

}  // namespace swept::inline SWEPT_PRECISION
