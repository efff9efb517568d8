#pragma once

#include <span>

#include "render_paint.h"

namespace swept {

/// Marks a surface that runs along an outline by arrowheads just inside of it, which run along.
/// @param points     pixels; what is solid lies on the left-hand side, seen along them.
/// @param way        of the surface so far, pixels along the points.
/// @param isForward  whether it runs along them.
/// @param pen        as in `PixelView`.
void markBelt(Paint& paint, std::span<const DVec2> points, bool loop, double way, bool isForward, Color color,
              double pen);

}  // namespace swept
