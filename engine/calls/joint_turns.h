#pragma once

#include "../state/joint.h"

/// Whole turns by which a joint is off as it takes hold of its bodies: nobody means it to turn them back.

namespace swept::inline SWEPT_PRECISION {

/// Whether nothing in a joint holds its angle, or drives it to one: whole turns are as good as other angles then.
bool mayTurnOn(const Joint& joint);

/// The whole turns, rad, from where a joint lets its bodies rest to an angle of it: without them it is off by half a
/// turn at most. What has no such place is taken as resting at 0.
double turnsOff(const Joint& joint, double angle);

}  // namespace swept::inline SWEPT_PRECISION
