#pragma once

#include <span>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

struct Circle {
    Vec2 center;
    Real radius = 0;  ///< metres, at least 0
};

/// Touching circles overlap, but for rounding: it may tell wrongly of circles whose distance is that of their radii to
/// within 2 eps. Squares beyond the range of `Real` are infinite or 0, and what both sides are so of overlaps: lengths
/// are to be between some 10⁻¹⁹ and 10¹⁹ m (in f64 10⁻¹⁵⁴ and 10¹⁵⁴).
constexpr bool overlaps(const Circle& a, const Circle& b) {
    return lengthSquared(b.center - a.center) <= square(a.radius + b.radius);
}

/// Smallest enclosing circle of a polygon, its radius included (Welzl's problem, solved by trying all pairs and triples
/// of at most 8 vertices). Rounded so that it contains every vertex.
Circle boundingCircle(const Polygon& polygon);

}  // namespace swept::inline SWEPT_PRECISION
