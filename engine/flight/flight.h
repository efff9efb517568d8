#pragma once

#include <cstdint>

#include "../state/flight_work.h"

namespace swept::inline SWEPT_PRECISION {

/// Integrates the whole step of a flyer: free flight to its first impact, the impact with all contacts of that moment,
/// and on through the remaining time; in mode `stop` that is lost. Touches only the body's own state and the scratch,
/// so flyers may run in any order.
void fly(WorldState& world, std::uint32_t body, double dt, FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
