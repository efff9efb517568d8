#pragma once

#include <cstdint>

#include "../events.h"
#include "../state/flight_work.h"
#include "../state/step_part.h"

namespace swept::inline SWEPT_PRECISION {

/// Integrates the whole step of a flyer: free flight to its first impact, the impact with all contacts of that moment,
/// and on through the remaining time; in mode `stop` that is lost. Touches only the body's own state and the scratch,
/// so flyers may run in any order.
void fly(WorldState& world, std::uint32_t body, double dt, FlightScratch& scratch);

/// Sweeps a body from its start pose of this part of the step to its present pose; at an impact with something static
/// or kinematic it stays there, keeps its velocity (less what it gained by falling in the time it lost), and the rest
/// of the part enters the ledger. Along what it is sunk into, and out of it, it goes on (`slideAlongSunk`): then the
/// share of its path that it missed does.
void clampAtImpact(WorldState& world, std::uint32_t body, const StepPart& part, LostTimeReason reason,
                   FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
