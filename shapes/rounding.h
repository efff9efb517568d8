#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "bit_cast.h"
#include "branchless.h"
#include "real.h"

/// Directed rounding, for results that must contain or bound the exact ones.

namespace swept::inline SWEPT_PRECISION {

/// The next larger floating-point number of a finite one; infinity above the largest.
template <class T>
constexpr T nextUp(T x) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    if (x == 0) { return std::numeric_limits<T>::denorm_min(); }
    const Bits bits = bitCast<Bits>(x);
    return bitCast<T>(x > 0 ? bits + 1 : bits - 1);
}

/// The next smaller one.
template <class T>
constexpr T nextDown(T x) {
    return -nextUp(-x);
}

/// The next smaller one of a number other than +0 (−infinity below the lowest), if so asked. Nobody can predict which
/// way a sum was rounded, so there is no branch, and four of them may go side by side: GCC 12 makes one of `?:`, at
/// which a box stands three times as long, but none of a mask.
template <class T>
constexpr T steppedDown(bool isAsked, T x) {
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    const Bits bits = bitCast<Bits>(x);
    const Bits isNegative = bits >> (8 * sizeof(T) - 1);
    const Bits step = 2 * isNegative - 1;
    return bitCast<T>(bits + (step & maskOf<Bits>(isAsked)));
}

/// The largest `Real` that is not above `x`; the nearest finite one where `x` is out of range. NaN stays NaN.
constexpr Real roundedDown(double x) {
    constexpr double kMax = static_cast<double>((std::numeric_limits<Real>::max)());
    const double low = x > kMax ? kMax : x;
    const double inRange = low < -kMax ? -kMax : low;
    const Real nearest = static_cast<Real>(inRange);  // not +0 where it is above: what is below 0 becomes −0
    return steppedDown(static_cast<double>(nearest) > inRange, nearest);
}

/// The smallest `Real` that is not below `x`; the nearest finite one where `x` is out of range. NaN stays NaN.
constexpr Real roundedUp(double x) { return -roundedDown(-x); }

/// The largest `Real` not above a + b. The error of a rounded sum is itself a floating-point number (Knuth's TwoSum),
/// so its sign says on which side of the exact sum the rounded one lies, however far apart the magnitudes are. The
/// nearest finite one where the sum is out of range; NaN stays NaN.
constexpr Real sumRoundedDown(Real a, Real b) {
    constexpr Real kMax = (std::numeric_limits<Real>::max)();
    const Real sum = a + b;
    const Real partOfB = sum - a;
    const Real partOfA = sum - partOfB;
    const Real error = (a - partOfA) + (b - partOfB);
    const Real down = steppedDown(error < 0, sum);  // a sum of 0 has no error
    return down > kMax ? kMax : (down < -kMax ? -kMax : down);
}

}  // namespace swept::inline SWEPT_PRECISION
