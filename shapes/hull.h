#pragma once

#include <span>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Convex hull of any cloud of points as a counter-clockwise polygon that starts at the lowest (then leftmost) vertex.
/// Points on an edge, repeated points, and points within rounding of an edge are no vertices. Orientation is judged in
/// double relative to the cloud's own size: there is no absolute tolerance.
/// Method: Andrew's monotone chain.
/// Errors: `notFinite`, `tooFewVertices` (empty), `degenerate` (all points equal or on a line), `tooManyVertices`
/// (more than 8 vertices on the hull), `negative` (radius). Cost O(n log n); any number of points.
Result<Polygon> convexHull(std::span<const Vec2> points, Real radius = 0);

}  // namespace swept::inline SWEPT_PRECISION
