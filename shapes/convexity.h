#pragma once

#include <span>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Sine of the smallest turn between two consecutive edges. Below about 2 eps the rounding of the cross product decides
/// its sign in double, and the two normals are the same number in `Real`.
inline constexpr double kSmallestTurn = 4 * static_cast<double>(kEpsilon);

/// Distance of a vertex from the chord of its neighbours, relative to the size of the cloud, below which it counts as a
/// point on the edge. Such a vertex turns by at least its height over the shorter edge, and that edge is at most √2
/// times the size, so every polygon with greater heights passes the test of the turn.
inline constexpr double kSmallestHeight = 2 * kSmallestTurn;

/// The larger side of the bounding box; 0 if all points are equal.
double sizeOf(std::span<const Vec2> points);

/// Distance of `q` from the segment from p to r; 0 unless p, q, r turn left. Not the distance from the line: the tip of
/// a needle may be close to that, and is yet what must stay.
double heightOver(Vec2 p, Vec2 q, Vec2 r);

/// ok, `notConvex`, or `degenerate` (all points within rounding of one line) for 3 to 8 finite vertices whose edges
/// are finite, however large or small.
StatusCode judgeConvexity(std::span<const Vec2> vertices);

}  // namespace swept::inline SWEPT_PRECISION
