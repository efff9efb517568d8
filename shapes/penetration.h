#pragma once

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

struct Penetration {
    Real separation = 0;  ///< core separation along `normal`, radii not included; negative when the cores overlap
    Vec2 normal;          ///< unit, from A to B, frame of A
    Vec2 pointA;          ///< core points that realise it, frame of A
    Vec2 pointB;
};

/// Largest separation of the cores (without radii) over all edge normals of both, in the frame of A. When the cores
/// overlap this is the minimum translation, exactly; when they are apart it is a lower bound of the distance.
/// A core without area (point, segment) adds the directions its Minkowski sum with the other has as faces.
Penetration penetration(const Polygon& a, const Polygon& b, const Transform& bInA);

}  // namespace swept::inline SWEPT_PRECISION
