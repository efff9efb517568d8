#pragma once

#include <optional>
#include <string>
#include <vector>

#include <swept/shapes/polygon.h>

#include "scene_description.h"

namespace swept {

/// What is wrong with a geometry beyond the range of its single numbers.
struct GeometryFault {
    std::string member;  ///< JSON pointer below the geometry's key ("/points/1"), or empty for the geometry itself
    std::string reason;
};

/// Distinct points, a proper hull, enough points: the rules that need more than one number at a time.
/// @param geometry  finite, with every number in its range.
std::optional<GeometryFault> geometryFault(const Geometry& geometry);

/// Mass and inertia of a body about its centre of mass; zero for what has no area.
struct MassAndInertia {
    double mass = 0;     ///< kg
    double inertia = 0;  ///< kg·m²
};

/// Sums over the shapes of a body, sensors included: a sensor weighs what its density says. Chains weigh nothing.
/// @param body  with valid geometries.
MassAndInertia massOfShapes(const BodyDescription& body);

/// The convex pieces of a shape in the frame of its body, radii included: one polygon, or one per segment of a chain.
/// Exists for the double build of `shapes` only.
std::vector<Polygon> piecesOf(const ShapeDescription& shape);

}  // namespace swept
