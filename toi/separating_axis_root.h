#pragma once

#include "time_of_impact.h"

namespace swept {

/// Root finding along separating axes (E. Catto, "Continuous collision", GDC 2013; the method of Box2D), in our own
/// words and code. From the current fraction t1, at which the bodies are apart:
///   1. GJK gives the closest direction. It becomes an axis: held in the body whose edge is closest, or in the world
///      when two vertices are.
///   2. At the end of the interval, t2, take the deepest vertices along the axis. If even they are above the target,
///      the bodies are declared separated (when they are just at it, t2 becomes the new t1).
///   3. Otherwise follow these two vertices from t1 to t2 and find a time at which they are at the target, by secant
///      and bisection in turns. It becomes the new t2; look for deeper vertices there, and push it back until there
///      are none.
///   4. Go on from there with a new axis, until GJK says that the target is reached.
///
/// @return `hit` within target ± tolerance, `separated`, `overlapped` at the start, or `failed` when a loop runs out of
///         its budget. Not certified: no statement holds about the fractions before the reported one, `failed`
///         included; the bracket of a hit is that of the last axis, between two distances. `iterations` counts distance
///         evaluations and evaluations along an axis.
/// Motion: complete, parabolas included.
/// Cost: typically two or three distance evaluations and a dozen along axes.
/// Fails: `separated` is decided by one axis at one fraction; a vertex that dips in and comes out again before the end
/// is never looked at, and a body that passed through and stands beyond a face that has turned with its body counts as
/// separated too. The bracket holds some root of a function that is not monotone: the hit found may not be the first.
Toi separatingAxisRoot(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                       const ToiSettings& settings);

}  // namespace swept
