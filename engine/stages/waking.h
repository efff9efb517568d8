#pragma once

#include <cstddef>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// A joint pulls: what is awake and moves wakes what hangs on it. @param from  place in `awake`
void wakeAcrossJoints(WorldState& world, std::size_t from);
/// What woke wakes others in turn, in the same step: what sleeps is as heavy as ground to whom it meets. Mostly all
/// that is tied together fell asleep and wakes together, but not what was put to sleep one by one.
/// @param from  place in `awake` of the first that woke
/// @pre all that touches is listed, but for what these wake
void wakeOnward(WorldState& world, std::size_t from);

}  // namespace swept::inline SWEPT_PRECISION
