#pragma once

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

struct RayCastHit {
    bool hit = false;
    Real fraction = 0;  ///< first t in [0, maxFraction] at which origin + t·direction lies on or in the shape
    Vec2 normal;        ///< outward unit normal there; (0, 0) when the ray starts inside (fraction 0)
    Vec2 point;
};

/// Ray against a convex polygon with radius, exact for the rounded outline (edges and arcs), in the frame of the shape.
/// @param direction  not zero; its length gives the unit of the fraction.
/// @param maxFraction  at least 0.
RayCastHit rayCast(const Polygon& polygon, Vec2 origin, Vec2 direction, Real maxFraction);

/// Whether a point lies in or on the rounded shape.
bool containsPoint(const Polygon& polygon, Vec2 point);

}  // namespace swept::inline SWEPT_PRECISION
