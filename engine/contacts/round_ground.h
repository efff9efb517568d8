#pragma once

#include "../../shapes/manifold.h"

namespace swept::inline SWEPT_PRECISION {

/// A face that lies on a large circle. It touches at one point, which runs along the face as the body tilts, by the
/// radius times the angle: faster than anything moves there, and a contact keeps its arms for a step. So whoever lay on
/// a hill rocked more and more, up to where its corners touched, and never slept. Where the face is off the circle by
/// no more than the slop it may as well touch: then it lies on two points.
///
/// @param closest  of a circle as A, which does not yield
/// @param slop     metres
/// @return `closest` unless that is one point, and the circle is large for B
Manifold lyingOnRound(const Polygon& circle, const Polygon& b, const Transform& bInA, Real margin, Real slop,
                      const Manifold& closest);

}  // namespace swept::inline SWEPT_PRECISION
