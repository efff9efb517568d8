#pragma once

#include <span>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

struct MassProperties {
    double mass = 0;     ///< kg
    DVec2 center;        ///< centre of mass, metres, body frame
    double inertia = 0;  ///< about the centre of mass, kg·m²
};

/// Mass properties of a uniform shape, exact for rounded polygons: the Minkowski sum of polygon and disk is split into
/// the polygon, one rectangle per edge and one circular sector per vertex. Computed in double about the shape's own
/// first vertex, so a shape far from the body origin loses nothing. A bare segment has no area and gives mass 0.
/// Lengths have fourth powers in the inertia: in f64 those below 10⁻⁷⁵ m or above 10⁷⁵ m may leave the range of double,
/// and mass or inertia are then 0, infinite or NaN (`isWeighable` tells). In f32 all lengths are in range.
/// @param density  kg/m², at least 0.
MassProperties massOf(const Polygon& polygon, Real density);

/// Whether mass and inertia are numbers, and what has mass resists turning.
bool isWeighable(const MassProperties& properties);

/// Sum of parts given in one frame (parallel-axis theorem about the common centre). Without mass all is 0.
MassProperties combine(std::span<const MassProperties> parts);

}  // namespace swept::inline SWEPT_PRECISION
