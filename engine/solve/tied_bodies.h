#pragma once

#include "../../shapes/function_ref.h"
#include "../state/world_state.h"
#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Slots for all bodies that take part in the solve of a group, and what contacts ask about them by these: which are
/// strained, and which ground turns. Free bodies were moved already: a kinematic one takes part with its velocity and
/// its pose at the start of the step. @pre the batch holds the fixed world alone
/// @param time  of the solve, s
void giveSlots(WorldState& world, const TiedGroup& group, Real time);
/// Sets those bodies. @param h  of a sub-step, s
/// @param beside  what one worker does while the others do that: it may ask for the slots alone
void setBodies(WorldState& world, const TiedGroup& group, Real h, FunctionRef<void()> beside);

/// Takes back what the solve did to them in `time`, s, by sub-steps of `h`, and takes from their islands what energy
/// these gained.
void readBodies(WorldState& world, const TiedGroup& group, Real time, Real h, double dt);

}  // namespace swept::inline SWEPT_PRECISION
