#pragma once

#include "time_of_impact.h"

namespace swept {

/// Every vertex of each body against every edge of the other, and every vertex against every vertex: for each such pair
/// the exact distance as a function of time, all its roots isolated by subdivision, the earliest at which the foot lies
/// on the edge. The first contact is among them, and none of them comes before it.
///
/// Radii and target shift the edges outwards; around vertices they make arcs, hence the pairs of vertices.
/// @return as `timeOfImpact`, with the same certificate, but at the root itself to the last digits instead of somewhere
///         in the tolerance (a curve that only touches counts from tolerance / 16 on); the bracket begins at fraction
///         0. `failed` at fraction 0 when the budget of evaluations is spent, which takes hundreds of turns.
///         `iterations` counts evaluations of one pair of features.
/// Motion: complete, parabolas included.
/// Source: what a textbook would do (for polyhedra: J. Canny, "Collision detection for moving polyhedra", 1986);
/// subdivision with a bound on the second derivative as for any smooth function.
/// Cost: 3·nA·nB searches of 2 to 20 evaluations, each with two sines and cosines; tens of microseconds for polygons,
/// growing with the turns in the sweep.
/// Fails: not at all within its budget; it is here as the slow truth.
Toi bruteForce(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
               const ToiSettings& settings);

/// Evaluations of one query: some tens of milliseconds. Bodies that turn four times take at most ten thousand.
inline constexpr int kMaxBruteForceEvaluations = 1 << 20;

}  // namespace swept
