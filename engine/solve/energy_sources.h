#pragma once

#include "tied_group.h"

/// What gives islands energy beside gravity and forces (energy_guard.h).

namespace swept::inline SWEPT_PRECISION {

/// What motors may have given islands that gained more than gravity and forces gave them, and what did give them that
/// follows targets.
/// @pre the group was booked and has its new motions
/// @param time  that was solved for, s
void bookMotors(WorldState& world, const TiedGroup& group, double time);

/// What springs gave, or took, of such islands. Of others nobody need know. @pre likewise
/// @param h  length of a sub-step, s
void bookSprings(WorldState& world, const TiedGroup& group, Real h);

}  // namespace swept::inline SWEPT_PRECISION
