#pragma once

#include <array>

#include "real.h"

/// What `sinCos` and its wide twin have in common.

namespace swept::inline SWEPT_PRECISION {

inline constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

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
