#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "real.h"

/// Directed rounding, for results that must contain or bound the exact ones.

namespace swept::inline SWEPT_PRECISION {

/// The next larger floating-point number of a finite one; infinity above the largest.
template <class T>
constexpr T nextUp(T x) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    if (x == 0) { return std::numeric_limits<T>::denorm_min(); }
    const Bits bits = std::bit_cast<Bits>(x);
    return std::bit_cast<T>(x > 0 ? bits + 1 : bits - 1);
}

/// The next smaller one.
template <class T>
constexpr T nextDown(T x) {
    return -nextUp(-x);
}

/// The largest `Real` that is not above `x`; the nearest finite one where `x` is out of range. NaN stays NaN.
constexpr Real roundedDown(double x) {
    constexpr Real kMax = std::numeric_limits<Real>::max();
    if (x >= static_cast<double>(kMax)) { return kMax; }
    if (x <= -static_cast<double>(kMax)) { return -kMax; }
    const Real nearest = static_cast<Real>(x);
    return static_cast<double>(nearest) > x ? nextDown(nearest) : nearest;
}

/// The smallest `Real` that is not below `x`; the nearest finite one where `x` is out of range. NaN stays NaN.
constexpr Real roundedUp(double x) { return -roundedDown(-x); }

}  // namespace swept::inline SWEPT_PRECISION
