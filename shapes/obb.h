#pragma once

#include "transform.h"

namespace swept::inline SWEPT_PRECISION {

/// Oriented bounding box: a rectangle with half extents `half` about the origin of `pose`.
struct Obb {
    Transform pose;
    Vec2 half;  ///< metres, at least 0
};

/// Separating-axis test on the four face normals; touching boxes overlap. Rounding may report two boxes that are apart
/// by less than 8 eps × (extents + distance) as overlapping, never the reverse.
bool overlaps(const Obb& a, const Obb& b);

/// Largest separation along the four face normals, metres: positive when apart (a lower bound of the distance),
/// negative when overlapping (minus the smallest translation that separates them).
Real separation(const Obb& a, const Obb& b);

}  // namespace swept::inline SWEPT_PRECISION
