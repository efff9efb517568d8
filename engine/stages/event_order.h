#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The order of the events is found, and which of them chains have as one shape (event_order.cpp): by one worker, which
/// runs no loops. Then they are put into it.
void sortEvents(WorldState& world);
void putEventsInOrder(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
