#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Bullets fly through the step in order of time: from impact to impact with static and kinematic shapes as flyers do,
/// and with dynamic bodies, which are taken along from the moment on that a bullet hits them. What is tied to others by
/// joints or contacts stays on the way that the solver gave it, and takes the impulse; a bullet that cannot get off it
/// rides on with it to the end of the step. A bullet that contacts alone keep on its way leaves it where that leads
/// through another such body, or is as long as that of something fast. Nothing but bullets and what they may hit is
/// looked at. Who takes part, and what each would meet first, is found on several threads; what happens then on one.
/// @pre one flight scratch per worker
void flyBullets(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
