#pragma once

#include "../../samples/runner.h"
#include "../../toi/time_of_impact.h"

namespace swept {

/// Answer of a distance query: world coordinates; signed metres, radii included.
struct QueryDistance {
    double distance = 0;
    DVec2 normal;
    DVec2 pointA;
    DVec2 pointB;
    int iterations = 0;
};

/// Distance of two polygons at fraction 0 by the distance function of one precision. Compiled once for each.
/// @return an error when the polygons are none any more once they are rounded to the precision (too large or too flat).
template <Precision precision>
Result<QueryDistance> queryDistance(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB);

template <>
Result<QueryDistance> queryDistance<Precision::f32>(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b,
                                                    const Sweep& sweepB);
template <>
Result<QueryDistance> queryDistance<Precision::f64>(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b,
                                                    const Sweep& sweepB);

}  // namespace swept
