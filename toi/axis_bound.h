#pragma once

#include "moving_pair.h"

namespace swept::inline SWEPT_PRECISION {

/// A direction held in the world, in A or in B while time goes on, and the separation of the cores along it: lowest
/// projection of B minus highest of A. Whatever the direction, this never exceeds the true separation.
struct HeldAxis {
    // Without initial values: all are written at once.
    AxisOwner holder;
    double spin;  ///< the rate at which it turns, radians per unit of fraction: 0, or that of its holder
    Vec2 normal;  ///< unit, world axes, at the fraction last looked at
    Vec2 inA;     ///< the same in the frames of the bodies
    Vec2 inB;
    int a;  ///< vertex of A that lies highest along it, vertex of B that lies lowest
    int b;
    double gap;  ///< separation of the cores along it, metres
};

/// The closest direction of a pose, held by `holder` from there on.
HeldAxis hold(const MovingPair& pair, const PairPose& pose, const Closest& closest, AxisOwner holder);
/// Any direction.
/// @param normal  unit, world axes.
HeldAxis hold(const MovingPair& pair, const PairPose& pose, Vec2 normal, AxisOwner holder);

/// Where a held axis points at a pose, world axes.
Vec2 directionAt(const PairPose& pose, const HeldAxis& axis);

/// Vertices of a convex polygon that lie side by side.
struct VertexRun {
    int first = 0;
    int count = 1;
    int step = 1;  ///< +1 or −1: which way around
};

/// How far a pair can be advanced, for certain, and which vertices can be the deepest ones on the way.
struct SafeAdvance {
    double step = 0;
    VertexRun a;
    VertexRun b;
    bool approaches = false;  ///< the separation along the axis falls at the start of the step
};

/// Whose distance from the centre is the |r| that bounds how a vertex swings. Either is right.
enum class VertexReach : std::uint8_t {
    farthest,  ///< that of the farthest vertex, for all: the cheaper, and hardly worse where the centre is in the
               ///< middle
    own,       ///< that of each vertex: longer steps where those that can touch are much nearer than the farthest
};

/// The largest time the pair can be advanced, for certain, before the separation along an axis may fall to `level`.
///
/// Let the axis turn at the rate w. With r a vertex of a body that turns at rate ω, measured from the body's centre,
/// and d the difference of the centres with velocity v and acceleration 2k, the derivatives after the fraction are
///
///     n·r    (ω − w)·(r × n),    −(ω − w)²·n·r,    then within ±|ω − w|³·|r|
///     n·d    w·(Jn·d) + n·v,    −w²·n·d + 2w·(Jn·v) + 2n·k,    then within ±(|w|³·|d| + 3w²·|v| + 6|w||k|)
///
/// (J: a quarter turn). So in a window of time each pair of vertices lies above a parabola with its own value, slope
/// and curvature, bent down by a third of the window times the bound of the third derivative. (Conservative
/// advancement, Mirtich 1996, has the value and a bound of the slope.) While the axis turns against a convex polygon
/// its deepest vertex walks along the boundary, one way: only the few vertices of that walk are looked at, the others
/// are never deepest. The window is where the second-order guess says the root is, so that little is given away to the
/// third derivative.
/// @param level  metres, radii included.
/// @param limit  the answer is sought in [0, limit]; fraction, greater than 0.
/// @return a step in [0, limit]; `limit` means that nothing happens up to there. Not an upper bound of anything.
SafeAdvance safeAdvance(const MovingPair& pair, const PairPose& pose, const HeldAxis& axis, double level, double limit,
                        VertexReach reach = VertexReach::farthest);

/// Looks along the axis at the end of an advance: `pose` is there already.
void follow(const MovingPair& pair, const PairPose& pose, const SafeAdvance& advance, HeldAxis& axis);

/// The bound by the circles about the centres that hold the bodies: no distance is needed, and spin does not count at
/// all. Exact on straight lines; on parabolas along the line of the centres.
/// @param fraction  from where; the answer is counted from there and lies in [0, limit].
double advanceOfCircles(const MovingPair& pair, double fraction, double level, double limit);

/// The largest of the advances along the closest direction, held by A, by B, by the world, and by the circles.
double bestAdvance(const MovingPair& pair, const PairPose& pose, const Closest& closest, double level, double limit);

}  // namespace swept::inline SWEPT_PRECISION
