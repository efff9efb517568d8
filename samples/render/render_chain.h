#pragma once

#include <span>

#include "render_paint.h"

namespace swept {

/// Shows which side of a chain is solid: a band that fades away from the line, and short hatches. Solid is the
/// left-hand side, seen along the chain; bodies collide with the right-hand side.
/// @param points  pixels, in the order of the chain.
/// @param pen     as in `PixelView`.
void shadeSolidSide(Paint& paint, std::span<const DVec2> points, bool loop, Color color, double pen);

}  // namespace swept
