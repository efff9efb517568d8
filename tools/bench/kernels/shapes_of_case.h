#pragma once

#include <swept/shapes/polygon.h>

#include "pair_cases.h"

/// The pairs in the numbers of a build. Their floats are exact in both.

namespace swept::bench::inline SWEPT_PRECISION {

inline Polygon polygonOf(const CoreShape& shape) {
    Polygon polygon;
    polygon.count = shape.count;
    polygon.radius = static_cast<Real>(shape.radius);
    for (std::size_t i = 0; i < static_cast<std::size_t>(shape.count); ++i) {
        polygon.vertices[i] = toReal(shape.vertices[i]);
    }
    for (int i = 0; i < shape.count && shape.count > 1; ++i) {
        polygon.normals[static_cast<std::size_t>(i)] = edgeNormal(
            polygon.vertices[static_cast<std::size_t>(i)], polygon.vertices[static_cast<std::size_t>(polygon.next(i))]);
    }
    return polygon;
}

inline Transform transformOf(const CorePose& pose) {
    return {toReal(pose.translation), {static_cast<Real>(pose.c), static_cast<Real>(pose.s)}};
}

}  // namespace swept::bench::inline SWEPT_PRECISION
