#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Takes what islands gained (energy_gain.h) from the motion of their members relative to each other, or to the ground
/// that they press on. @pre it is known what else has a part in their motion
/// @param time  that was solved for, s
void takeBackGains(WorldState& world, const TiedGroup& group, double time);

}  // namespace swept::inline SWEPT_PRECISION
