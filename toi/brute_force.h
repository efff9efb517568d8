#pragma once

#include "time_of_impact.h"

namespace swept {

/// Every vertex of each body against every edge of the other, and every vertex against every vertex: for each such pair
/// the exact distance as a function of time, all its roots isolated by subdivision, the earliest at which the foot lies
/// on the edge. The first contact is among them, and none of them comes before it.
///
/// Radii and target shift the edges outwards; around vertices they make arcs, hence the pairs of vertices.
/// @return as `timeOfImpact`, with the same certificate, but at the root itself to the last digits instead of somewhere
/// in
///         the tolerance. `failed` at fraction 0 when the budget of evaluations is spent, which takes thousands of
///         turns. `iterations` counts evaluations of one pair of features.
/// Motion: complete, parabolas included.
/// Source: what a textbook would do (for polyhedra: Canny, "Collision detection for moving polyhedra", 1986);
/// subdivision with a bound on the second derivative as for any root of a smooth function. Cost: of the order of
/// 2·nA·nB + nA·nB searches of 3 to 20 evaluations, each with two sines and cosines; tens of microseconds for boxes,
/// growing with the turns in the sweep. Fails: not at all within its budget; it is here as the slow truth.
Toi bruteForce(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
               const ToiSettings& settings);

/// Evaluations of one query: a fraction of a second.
inline constexpr int kMaxBruteForceEvaluations = 1 << 22;

}  // namespace swept
