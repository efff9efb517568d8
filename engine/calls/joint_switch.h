#pragma once

#include <cstdint>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Turns the joints of a body on and off, as `canHold` has it: of one that was enabled or disabled, or is of another
/// type now. Those that are turned on take hold of their bodies as they are by then.
void switchJoints(WorldState& world, std::uint32_t body);

}  // namespace swept::inline SWEPT_PRECISION
