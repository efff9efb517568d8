#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// How far a joint is off: its gap, as a part of the smallest extent of its bodies, or what they are turned, rad.
Real gapOf(const WorldState& world, const Joint& joint);

/// Joints that are torn, or burst, work against each other. What each begins the next step with would grow without end,
/// and so would the way that bodies go: they go as far as what is left of their speed takes them.
/// @pre `takeBackGains`
/// @param time  that was solved for, s
void calmTorn(WorldState& world, const TiedGroup& group, double time);

}  // namespace swept::inline SWEPT_PRECISION
