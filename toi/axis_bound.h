#pragma once

#include "moving_pair.h"

namespace swept::inline SWEPT_PRECISION {

/// The largest time the pair can be advanced, for certain, before its separation may fall to `level`.
///
/// Whatever the unit axis n(s), the separation along it, min over B minus max over A of the vertices' projections, never
/// exceeds the true separation. Let the axis turn at a constant rate w (0: held in the world; spinA or spinB: held in a
/// body). With r a vertex of a body that turns at rate ω, measured from the body's centre, and d the difference of the
/// centres with velocity v and acceleration 2k,
///
///     n·r   changes at the rate (ω − w)·(r × n),            and its second derivative is within ±(ω − w)²·|r|
///     n·d   changes at the rate w·(Jn·d) + n·v,             and its second derivative is within
///                                                            ±(w²·|d| + 2·|w|·|v| + 2·|k|);  exactly 2·n·k if w = 0
///
/// (J: a quarter turn). So each projection lies above a parabola through its value with its slope, and the separation
/// above the lower envelope of such parabolas; the first time the envelope is at `level` is a safe advance. It is exact
/// to second order, which is why few steps suffice where a first-order bound (conservative advancement, Mirtich 1996)
/// creeps.
///
/// The best of the three axes that hold the closest direction in the world, in A and in B is taken, and of the pair's
/// bounding circles about the centres, for which spin does not count at all.
/// The axis is first held where the closest feature says it is held best (a face normal turns with its body); the others
/// are looked at when that gains little.
/// @param pose   where the pair stands now.
/// @param level  metres, radii included, below the separation of the pose.
/// @param limit  the answer is sought in [0, limit]; fraction, greater than 0.
/// @return in [0, limit]; `limit` means that nothing happens up to there. Not an upper bound of anything.
double safeAdvance(const MovingPair& pair, const PairPose& pose, double level, double limit);

/// The bound by the circles about the centres that hold the bodies, along the line of the centres: no distance is needed.
/// @param offset, velocity, curvature  of B's centre relative to A's, in any frame.
double advanceOfCircles(const MovingPair& pair, Vec2 offset, Vec2 velocity, Vec2 curvature, double level, double limit);

}  // namespace swept::inline SWEPT_PRECISION
