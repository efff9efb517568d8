#pragma once

#include <limits>

#include "../../shapes/real.h"

/// All tolerances of the engine, as ratios to lengths of the scene (`extent`: smallest non-zero width of a shape, of a
/// pair the smaller one). There are no absolute lengths. Powers of two, so that scaled scenes give scaled results.

namespace swept::inline SWEPT_PRECISION {

/// Separation at which continuous collision counts two shapes as touching, and how exactly it is met.
inline constexpr Real kTargetRatio = Real(1) / 1024;
inline constexpr Real kToleranceRatio = kTargetRatio / 4;
/// Flyers come closer before they bounce: what they turn back too early is an error of height and time. But not closer
/// than so many roundings of the pair's coordinates, in which times of impact are found (double), or one of its
/// manifolds (`Real`).
inline constexpr Real kFlightTargetRatio = kTargetRatio / 64;
inline constexpr Real kFlightRoundings = 16;
/// Contacts begin below 2 and end above 4 targets: resting jitter and the TOI's own band lie below the first.
inline constexpr Real kBeginRatio = 2 * kTargetRatio;
inline constexpr Real kEndRatio = 4 * kTargetRatio;
/// A contact point this part of the extent away from an old one, of other features, takes over its impulses.
inline constexpr Real kSamePlaceRatio = Real(1) / 32;
/// A body is fast when some point of it may move more than this part of its extent in the step.
inline constexpr Real kFastRatio = Real(1) / 4;
/// Likewise, of a body with a shape of no thickness (but a skin, line_skin.h): sunk in by half of a thin peg it would
/// come out on the other side of it.
inline constexpr Real kLineRatio = kTargetRatio / 8;
/// For a bullet that flies freely this part is enough. Where two glance off each other, the normal of where they meet
/// decides; the solver has that of up to a step before instead, which for slow bullets would be up to 7° off.
inline constexpr Real kFastBulletRatio = Real(1) / 128;
/// Contact points are made ahead of time up to the motion of a step, but no farther than this part of the extent (what
/// moves farther is fast, and swept), and at least as far as the second one, so that resting contacts never flicker.
inline constexpr Real kMaxReachRatio = Real(1) / 4;
inline constexpr Real kMinReachRatio = Real(1) / 128;
/// What may come to move farther than this part of its extent in a step, since it is struck, is stirred (stirred.h): so
/// far ahead of it contact points are made at least.
inline constexpr Real kStirRatio = Real(1) / 8;
/// By the two of them: how far ahead of a body contact points are made. @param motion  of a step, at most, metres
/// @param isAhead  in mode `speculative`, however far
constexpr Real reachOfMotion(Real motion, Real extent, bool isAhead) {
    const Real least = kMinReachRatio * extent;
    const Real most = kMaxReachRatio * extent;
    const Real capped = isAhead || motion < most ? motion : most;
    return capped < least ? least : capped;
}
/// A manifold is kept as long as its points, and the shapes by angle, have moved less than this part of the extent, or
/// radians: the square of it is half a rounding.
inline constexpr Real kKeepRatio = std::numeric_limits<Real>::digits == 24 ? Real(0x1p-12) : Real(0x1p-26);
/// Boxes are made larger than needed by this part of the extent, to be moved more rarely.
inline constexpr Real kBoxMarginRatio = Real(1) / 8;
/// What contacts need to know of is told by boxes that hold all of what rests as long as it stays within this part of
/// the extent.
inline constexpr Real kRestRoomRatio = kMinReachRatio / 2;
/// Fast shapes whose farthest point is no farther from the centre than this part of their extent (squares: 0.71) have
/// the boxes of their circles.
inline constexpr Real kRoundRatio = Real(3) / 4;
/// Of bodies without contacts they also reach ahead along the velocity for so many steps, unless that is more than so
/// many extents: a box of a bullet, or in a crowd, that reaches far ahead finds more than it saves.
inline constexpr Real kBoxStepsAhead = 2;
inline constexpr Real kMaxAheadRatio = 4;
/// Bodies that pass each other are no farther apart than this part of their extent where they may be stopped by one
/// another within the step (hemmed_pairs.h).
inline constexpr Real kHemRatio = Real(1) / 16;
/// Fastest push out of an overlap: this part of the pair's extent per step.
inline constexpr Real kPushRatio = Real(1) / 16;
/// A flyer that overlaps something by up to this part of the extent is set back to the surface before it flies on.
inline constexpr Real kShallowRatio = 8 * kTargetRatio;
/// A fast body that contacts hold (the soft solver) may sink into them by this part of the extent before it is stopped.
/// What is no deeper in something stands on it, where a shape is cast from there.
inline constexpr Real kSlackRatio = Real(1) / 8;
/// The way of a cast shape that starts in contact goes along the surface as long as it leads into it by no more than so
/// many roundings of its length.
inline constexpr Real kAlongRoundings = 16;
/// A body rests while it moves less than this part of its extent …
inline constexpr Real kRestRatio = kTargetRatio;
/// … for so many steps, and for so many times √(extent/|gravity|).
inline constexpr int kRestSteps = 32;
inline constexpr double kRestTimes = 4;
/// Without gravity that is no time, and steps may be as short as slow motion has them: then for so many seconds.
inline constexpr double kWeightlessRest = 0.5;

}  // namespace swept::inline SWEPT_PRECISION
