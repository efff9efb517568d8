#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The most energy that a joint which is not passive may have given its bodies in so many seconds, J. A motor pushes as
/// hard as it may at most, and only up to its speed: faster bodies it brakes. So a brake gives none. Infinity of what
/// follows a target, and where a spring is beside the motor.
double mostWorkOf(const Joint& joint, double time);

/// How two bodies that a joint holds stood before a solve, and stand after it.
struct JointMoves {
    BodyMotion beforeA;
    BodyMotion beforeB;
    BodyMotion afterA;
    BodyMotion afterB;
};

/// What a joint that follows a target, or has a spring beside its motor, gave its bodies, J: its mean force of the
/// solve times the way of what it pushes, along which it is free to push, and its torque times the turn. Negative where
/// it braked.
/// @pre its reactions are those of the solve
double workDoneBy(const WorldState& world, const Joint& joint, const JointMoves& moves);

}  // namespace swept::inline SWEPT_PRECISION
