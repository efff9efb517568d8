#pragma once

#include "../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// A constraint as a damped spring, integrated implicitly over one sub-step (Catto, "Soft Constraints", GDC 2011): the
/// bias velocity is biasRate·C, the effective mass is scaled, and a part of the accumulated impulse is given back.
struct Softness {
    Real biasRate = 0;      ///< 1/s
    Real massScale = 1;
    Real impulseScale = 0;
};

inline constexpr Softness kRigid{};

/// @param angularFrequency  2π·hertz, rad/s, greater than 0
/// @param dampingRatio      at least 0
/// @param h                 length of the sub-step, s
constexpr Softness softnessOf(Real angularFrequency, Real dampingRatio, Real h) {
    const Real a1 = 2 * dampingRatio + h * angularFrequency;
    const Real a2 = h * angularFrequency * a1;
    const Real a3 = 1 / (1 + a2);
    return {angularFrequency / a1, a2 * a3, a3};
}

/// Stiffness that follows the sub-step rate: `cycles` oscillations a sub-step, at most a quarter, the stiffest spring that one
/// sub-step still samples well. The error of resting scenes then falls with the square of the number of sub-steps.
constexpr Softness softnessOfSubStep(Real cycles, Real dampingRatio, Real h) {
    constexpr Real kTwoPi = static_cast<Real>(6.283185307179586);
    return softnessOf(kTwoPi * cycles / h, dampingRatio, h);
}

/// Half of what a joint can take: the two points of a wide flat contact push on each other through its rotation, and with a
/// quarter a stack of twenty planks of 37:1 never came to rest.
inline constexpr Real kContactCycles = Real(1) / 8;
inline constexpr Real kJointCycles = Real(1) / 4;
/// Strongly overdamped: a contact must push out without bouncing.
inline constexpr Real kContactDampingRatio = 10;
inline constexpr Real kJointDampingRatio = 2;

}  // namespace swept::inline SWEPT_PRECISION
