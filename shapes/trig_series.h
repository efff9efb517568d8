#pragma once

#include <array>

#include "real.h"

/// What `sinCos` and its wide twin have in common.

namespace swept::inline SWEPT_PRECISION {

inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

// π/2 = kHalfPi1 + kHalfPi2 + kHalfPi3 up to 2⁻¹¹⁸. The first two have at most 33 bits, so their products with a
// quadrant number of 20 bits are exact.
inline constexpr double kHalfPi1 = 0x1.921fb544p+0;
inline constexpr double kHalfPi2 = 0x1.0b4611a4p-34;
inline constexpr double kHalfPi3 = 0x1.13198a2e03707p-65;

/// Beyond this the angle is first reduced by the exact remainder of the rounded 2π.
inline constexpr double kLargestExactAngle = 0x1p20;

/// Exact up to 22!
constexpr double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

// Taylor's polynomials; on [−π/4, π/4] the first terms left out, x¹⁹/19! and x¹⁸/18!, are below 2⁻⁵⁸.
inline constexpr std::array<double, 8> kSine = {-1 / factorial(3),  1 / factorial(5),   -1 / factorial(7),
                                                1 / factorial(9),   -1 / factorial(11), 1 / factorial(13),
                                                -1 / factorial(15), 1 / factorial(17)};
inline constexpr std::array<double, 7> kCosine = {1 / factorial(4),   -1 / factorial(6), 1 / factorial(8),
                                                  -1 / factorial(10), 1 / factorial(12), -1 / factorial(14),
                                                  1 / factorial(16)};

}  // namespace swept::inline SWEPT_PRECISION
