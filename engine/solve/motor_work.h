#pragma once

#include "../state/joint.h"

namespace swept::inline SWEPT_PRECISION {

/// The most energy that a joint which is not passive may have given its bodies in so many seconds, J. A motor pushes as
/// hard as it may at most, and only up to its speed: faster bodies it brakes. So a brake gives none. Infinity of what
/// follows a target, and where a spring is beside the motor.
double mostWorkOf(const Joint& joint, double time);

}  // namespace swept::inline SWEPT_PRECISION
