#pragma once

#include <algorithm>

#include "../../solver/softness.h"
#include "joint_place.h"

/// Joints that cannot hold: something kinematic, or a target, goes on while what hangs on it is stopped; or bodies were
/// put on both sides of a wall.

namespace swept::inline SWEPT_PRECISION {

/// How far a joint is off, as a part of the smallest extent of its bodies, or in radians, whichever is more.
Real errorRatio(const WorldState& world, const Joint& joint, const JointErrors& errors);

/// Whether something keeps it from closing a gap that a call left.
inline bool isStuck(const WorldState& world, const Joint& joint) {
    return joint.driven != kNotDriven && world.drivenJoints[joint.driven].isStuck;
}
/// Whether the gap of any joint may grow without end, by what nothing stops, or stay. A mouse joint may tear in any
/// world.
inline bool mayAnyTear(const WorldState& world) { return world.kinematicBodies > 0 || world.anyStuck; }
/// That of this one.
inline bool mayTear(const WorldState& world, const Joint& joint) {
    return world.kinematicBodies > 0 || isStuck(world, joint);
}

/// A joint is a spring, the stiffest one that a sub-step samples, and so it pulls the harder the farther it is off. A
/// contact gives way to it by twelve times its gap: what a train dragged against a wall was pressed through that, swept
/// back to it, and pulled again, with ten thousand times its weight and more (it went at 3319 m/s behind a train of 5,
/// once that was 30 m beyond the wall). So the pull grows up to a gap of half an extent: with less of it, light links
/// carry no load of hundreds of times their mass. What is off by more is torn, and where it touches something its pull
/// goes down to one that contacts bear. A mouse joint pulls no harder than that at any gap: it holds a body itself.
inline constexpr Real kMostGap = Real(1) / 2;    ///< extents at which a joint pulls hardest
inline constexpr Real kTornPull = Real(1) / 16;  ///< extents: the pull of such a gap is what is left in the end
inline constexpr Real kMostTwist = Real(1) / 8;  ///< radians, likewise, from which on it stays the same

/// Part of its pull that is left to a joint that is off. @param ratio  its gap over an extent, greater than 0
inline Real shareOfPull(Real ratio, bool isTornAtOnce, bool isTouching) {
    const Real torn = kTornPull / ratio;
    if (isTornAtOnce) { return torn; }
    return isTouching ? std::max(torn, square(kMostGap / ratio)) : kMostGap / ratio;
}

/// Whether one of its bodies touches something: what does not comes back from afar sooner.
inline bool isTouching(const WorldState& world, const Joint& joint) {
    const auto bodies = joint.allBodies();
    return std::any_of(bodies.begin(), bodies.end(),
                       [&world](std::uint32_t slot) { return world.bodies[slot].hasContact; });
}

/// Whether a call moved what it holds far: nothing tears it, and it closes its gap at once. (A mouse is led.) Until it
/// is known to be stuck.
inline bool isYanked(const WorldState& world, const Joint& joint) {
    return joint.driven != kNotDriven && world.drivenJoints[joint.driven].isYank;
}

/// Part of its pull that a joint has; less than 1 if it is torn.
/// @param errors  of its anchors, lengths, angles and limits
inline Real pullOf(const WorldState& world, const Joint& joint, const JointErrors& errors) {
    const bool isMouse = joint.type() == JointType::mouse;
    const Real ratio = errorRatio(world, joint, {errors.length, 0});
    const bool isTornAtOnce = isMouse || (isStuck(world, joint) && isTouching(world, joint));
    Real share = ratio > (isTornAtOnce ? kTornPull : kMostGap)
                     ? shareOfPull(ratio, isTornAtOnce, isTouching(world, joint))
                     : Real(1);
    if (errors.angle > kMostTwist) { share = std::min(share, kMostTwist / errors.angle); }
    return share < 1 && (isMouse || !isYanked(world, joint)) ? share : Real(1);
}

/// @param errors  as `pullOf`
inline Softness easedOf(const Softness& softness, const WorldState& world, const Joint& joint,
                        const JointErrors& errors) {
    const Real share = pullOf(world, joint, errors);
    if (!(share < 1)) { return softness; }
    return {share * softness.biasRate, softness.massScale, softness.impulseScale};
}

}  // namespace swept::inline SWEPT_PRECISION
