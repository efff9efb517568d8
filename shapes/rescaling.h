#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "vec2.h"

/// In f64, products of up to four coordinates leave the range of double where these are huge or tiny. What meets such
/// numbers brings them near 1 by a power of two first, and scales its answer back. Floats need none of it: their
/// products are taken in double.

namespace swept::inline SWEPT_PRECISION {

inline constexpr bool kProductsMayOverflow = sizeof(Real) == sizeof(double);

/// Whether products of numbers up to `size`, of which the largest is that, keep all their digits.
inline bool productsFit(double size) {
    constexpr double kLargest = 0x1p200;
    return size <= kLargest && size >= 1 / kLargest;
}

/// Larger coordinate, without its sign.
inline double largestOf(Vec2 v) { return static_cast<double>((std::max)(std::fabs(v.x), std::fabs(v.y))); }
inline double largestOf(std::span<const Vec2> points) {
    double largest = 0;
    for (const Vec2 v : points) { largest = (std::max)(largest, largestOf(v)); }
    return largest;
}

/// That of the power of two just above `size`; 0 of what is 0 or no number.
inline int exponentOf(double size) {
    int exponent = 0;
    if (std::isfinite(size)) { (void)std::frexp(size, &exponent); }
    return exponent;
}

inline Vec2 rescaled(Vec2 v, int exponent) { return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent)}; }

}  // namespace swept::inline SWEPT_PRECISION
