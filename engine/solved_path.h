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

}  // namespace swept::inline SWEPT_PRECISION
