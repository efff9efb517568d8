#pragma once

#include <cstdint>

#include "../events.h"
#include "../state/flight_work.h"
#include "../state/step_part.h"

namespace swept::inline SWEPT_PRECISION {

/// Sweeps a body from its start pose of this part of the step to its present pose; at an impact with something static
/// or kinematic it stays there, keeps its velocity (less what it gained by falling in the time it lost), and the rest
/// of the part enters the ledger. Along what it is sunk into, and out of it, it goes on (`slideAlongSunk`): then the
/// share of its path that it lost does. That the ground keeps it from getting deeper is no loss, as it is none to what
/// stands on ground that does not give, unless something kinematic presses it there, and goes on without it.
void clampAtImpact(WorldState& world, std::uint32_t body, const StepPart& part, LostTimeReason reason,
                   FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
