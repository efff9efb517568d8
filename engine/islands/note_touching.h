#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// What the contacts of a step tell about their bodies, and which bodies they tie together. Forgets what sleeps or
/// passes by. @pre traits are those of the step, and `WorldState::islands` was reset
void noteTouching(WorldState& world, Real dt);

}  // namespace swept::inline SWEPT_PRECISION
