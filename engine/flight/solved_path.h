#pragma once

#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {

/// From `Body::startCenter` and `startAngle` to the present pose.
Sweep pathOf(const WorldState& world, std::uint32_t body);
/// Whether that path is longer than a body that is not fast moves in this share of a step.
bool movedFast(const WorldState& world, std::uint32_t body, double share = 1);
/// First impact on that path of what the contact solver moved within `time` seconds, with the slack that this has.
/// @param ignoresSunk  see `firstImpact`
FirstImpact impactOfPath(const WorldState& world, std::uint32_t body, double time, double limit, FlightScratch& scratch,
                         bool ignoresSunk = false);

/// What would get deeper into what it is sunk into than it may goes on along it, and out of it, as far as nothing else
/// is in the way: its present pose is set off along the normal. Held wholly, it would stand while all that it is joined
/// to moves on.
/// @param first  on the path to the present pose; then on that to the new one
/// @return whether it gets farther so; otherwise nothing changes
bool slideAlongSunk(WorldState& world, std::uint32_t body, double time, FirstImpact& first, FlightScratch& scratch);

/// Notes what its shapes cross at the end of the path (chain_crossing.h), if a search met the back of a chain.
void noteCrossingsOfPath(const WorldState& world, std::uint32_t slot, double time, FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
