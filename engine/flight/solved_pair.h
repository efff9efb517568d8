#pragma once

#include "../state/world_state.h"

/// Two dynamic bodies on the ways that the solver gave both, taken as straight ones.

namespace swept::inline SWEPT_PRECISION {

/// What touches as these begin is held by a contact, which is soft, and may sink in by the slack.
void allowTouch(const WorldState& world, FlightObstacle& shapes, const Sweep& own, const Sweep& other);

/// Of two shapes that meet at a fraction of these: whether they end in each other, or past each other, farther than a
/// contact allows. Else they did not go straight: what rides on something that turns ends on the side that it was on.
bool endsBeyond(const WorldState& world, const FlightObstacle& shapes, const Sweep& own, const Sweep& other,
                double fraction);

}  // namespace swept::inline SWEPT_PRECISION
