#pragma once

#include <span>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

struct Circle {
    Vec2 center;
    Real radius = 0;  ///< metres, at least 0
};

/// Touching circles overlap.
constexpr bool overlaps(const Circle& a, const Circle& b) {
    return lengthSquared(b.center - a.center) <= square(a.radius + b.radius);
}

/// Smallest enclosing circle of a polygon, its radius included (Welzl's problem, solved by trying all pairs and triples
/// of at most 8 vertices). Rounded so that it contains every vertex.
Circle boundingCircle(const Polygon& polygon);

}  // namespace swept::inline SWEPT_PRECISION
