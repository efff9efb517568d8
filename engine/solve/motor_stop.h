#pragma once

#include <algorithm>

#include "../../solver/joints/freedom_parts.h"

namespace swept::inline SWEPT_PRECISION {

/// A motor ends where the limits of its joint do: it comes no farther in a step than to them, holds there whatever it
/// wanted beyond, and comes back if it was carried past. Its torque and that of the limit would end each other anyway,
/// but limits are softer than a strong motor, which would leave them behind. Another load on the limit it bears too.
/// @param place  of the joint now, rad or metres; @param dt  of the step
inline void endAtLimits(FreedomParts& parts, Real place, Real dt) {
    if (!parts.hasMotor || !parts.hasLimits) { return; }
    const Real speed = parts.motorSpeed;
    if (speed > 0) { parts.motorSpeed = std::clamp((parts.upper - place) / dt, -speed, speed); }
    if (speed < 0) { parts.motorSpeed = std::clamp((parts.lower - place) / dt, speed, -speed); }
}

}  // namespace swept::inline SWEPT_PRECISION
