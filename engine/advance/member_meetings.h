#pragma once

#include <span>

#include "../state/step_part.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Bullets that joints hold are swept against the other members of their island, on the ways that the solver gave both
/// (bullets_ahead.h). Fraction of a part of the step, which was solved, at which the first of them meets one; `limit`:
/// none does before that. Those that touch as the part begins may sink in as far as into ground.
double firstMeetingOf(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part, double limit,
                      FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
