#pragma once

#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Contacts that close loops are solved all at once in islands of so many bodies, as long as they are at rest. Larger
/// ones, up to `kMostWebBodies`, have to begin at rest, or to have been solved so in the step before, and remember what
/// that cost: a search for what presses and sticks that does not end must not stop the world.
inline constexpr std::uint32_t kSmallWebBodies = 256;
inline constexpr std::uint32_t kMostWebBodies = 2048;

/// Gives every body that the solver moves the effort of its island, from the state alone.
void assignEfforts(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
