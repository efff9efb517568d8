#pragma once

#include "../../solver/softness.h"
#include "joint_place.h"

/// Joints that cannot hold: something kinematic, or a target, goes on while what hangs on it is stopped.

namespace swept::inline SWEPT_PRECISION {

/// How far a joint is off, as a part of the smallest extent of its bodies, or in radians, whichever is more.
Real errorRatio(const WorldState& world, const Joint& joint, const JointErrors& errors);

/// Whether gaps may grow without end, by what nothing stops. A mouse joint may tear in any world.
inline bool mayTear(const WorldState& world) { return world.kinematicBodies > 0; }

/// A joint is a spring, the stiffest one that a sub-step samples, and so it pulls the harder the farther it is off. A
/// contact gives way to it by twelve times its gap: what a train dragged against a wall was pressed through that, swept
/// back to it, and pulled again, with ten thousand times its weight and more (it went at 3319 m/s behind a train of 5,
/// once that was 30 m beyond the wall). So from this gap on, in extents or radians, the pull does not grow: the contact
/// holds then. It is still that of hundreds of bodies of the kind that the joint holds, and closes gaps at some
/// extents per second.
inline constexpr Real kMostPull = Real(1) / 16;

/// @param errors  of its anchors, lengths, angles and limits
inline Softness easedOf(const Softness& softness, const WorldState& world, const Joint& joint,
                        const JointErrors& errors) {
    const Real ratio = errorRatio(world, joint, errors);
    if (!(ratio > kMostPull)) { return softness; }
    return {kMostPull / ratio * softness.biasRate, softness.massScale, softness.impulseScale};
}

}  // namespace swept::inline SWEPT_PRECISION
