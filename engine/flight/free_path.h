#pragma once

#include "../../toi/sweep.h"
#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// What acceleration and damping do to a body within a time, exactly.
struct Drift {
    DampedMotion linear;
    DampedMotion angular;
    DVec2 acceleration;          ///< m/s²
    double angularAcceleration;  ///< rad/s²
    double time;                 ///< s
};

/// A motion without its pose: of a dynamic body that nothing meets.
struct FreeVelocity {
    Vec2 linear;
    Real angular;
};

Drift driftOf(const WorldState& world, const Body& body, double time);
/// The parabola through its exact end points with the present velocity. Exact without damping.
Sweep freePath(const Body& body, const BodyMotion& motion, const Drift& drift);
/// With which a body began that got so far, and turned so far (rad), by its end.
FreeVelocity velocityBefore(DVec2 way, double turn, const Drift& drift);
/// With which it began that moves so at the end of the drift. What damping left next to nothing of moves so all the
/// time: the rest of it is rounding.
FreeVelocity velocityBefore(const BodyMotion& end, const Drift& drift);
/// At the end of the drift.
FreeVelocity velocityAfter(const BodyMotion& motion, const Drift& drift);

/// The whole step of a flyer that nothing static or kinematic can meet: one query of the broadphase, and it is there.
/// @return false: something may be in the way, or limits its speed; nothing was changed
bool flyClear(WorldState& world, std::uint32_t body, double dt);

}  // namespace swept::inline SWEPT_PRECISION
