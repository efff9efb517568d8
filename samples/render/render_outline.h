#pragma once

#include <span>
#include <vector>

#include "../scene_description.h"
#include "render_paint.h"

namespace swept {

/// A shape as points and a radius around them.
struct ShapeCore {
    std::vector<DVec2> points;  ///< convex and counter-clockwise; a chain: in its order
    double radius = 0;
};

/// In the frame of the body, metres.
ShapeCore shapeCore(const Geometry& geometry, double radius);

/// The convex hull, counter-clockwise, without points on its edges.
std::vector<DVec2> convexHull(std::vector<DVec2> points);

/// Smallest width of a convex shape, radius included.
double narrowestWidth(const ShapeCore& core);

/// The outline of a convex shape, arcs replaced by chords that deviate by less than a twentieth of a pixel as far as
/// they are visible; invisible arcs get no points, so a circle of a million pixels costs no more than a small one.
/// @param core  pixels; one point is a circle, two are a capsule.
/// @param box   what is visible.
std::vector<DVec2> roundedOutline(const ShapeCore& core, const PixelBox& box);

/// The same shape with `depth` (pixels) taken off all around; empty when nothing is left. What lies far outside of the
/// box may be missing.
ShapeCore insetCore(const ShapeCore& core, double depth, const PixelBox& box);

}  // namespace swept
