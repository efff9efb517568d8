#pragma once

#include <algorithm>

#include "../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// By how much the separation of a contact point may be wrong, metres: places on one body are told relative to the
/// other, so they are rounded as lengths are that reach from the centres of both to the point. On a piece of ground
/// that begins far from where a body rests that is more than what is asked of the body itself.
/// @param anchorA, anchorB  of the point, from the centres of mass, metres
inline Real separationRounding(Vec2 anchorA, Vec2 anchorB) {
    constexpr Real kRoundings = 4 * kEpsilon;
    return kRoundings * std::max(length(anchorA), length(anchorB));
}

}  // namespace swept::inline SWEPT_PRECISION
