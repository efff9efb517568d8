#pragma once

#include "../shapes/polygon.h"
#include "time_of_impact.h"

namespace swept::inline SWEPT_PRECISION {

/// A shape of either build as `toi/` takes it; exact, as float fits into double.
inline ToiPolygon asToiPolygon(const Polygon& polygon) {
    ToiPolygon result;
    result.count = polygon.count;
    result.radius = static_cast<double>(polygon.radius);
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        result.vertices[i] = toDouble(polygon.vertices[i]);
    }
    return result;
}

}  // namespace swept::inline SWEPT_PRECISION
