#pragma once

#include "../../shapes/polygon.h"

namespace swept::inline SWEPT_PRECISION {

struct Shape;

/// What has no thickness cannot be held by something that has none either, or hardly any: however little a contact
/// lets it sink in, it is on the other side then, and pushed out there. So a segment without a radius that can be moved
/// by contacts, that of a dynamic body, collides as if it had one of this part of its length: whatever stops a plank
/// that thin stops it. Its mass, and what the user gets back, are those of the segment.
inline constexpr Real kSkinRatio = Real(1) / 4096;

/// The polygon that the user gave.
Polygon givenPolygon(const Shape& shape);

/// For a shape that is not of a chain: whether its body is dynamic, and it is no sensor, decides what it collides with.
/// Measures it anew.
void setSkin(Shape& shape, bool isDynamic);

}  // namespace swept::inline SWEPT_PRECISION
