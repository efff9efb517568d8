#include "interval.h"

#include <array>

/// Sine and cosine without libm.
///
/// 1. Reduction. The middle m of the angle is a double. With k the integer nearest to m · 2/π (any integer would do;
/// this
///    one makes r small), r = m − k · π/2 is computed in interval arithmetic, with π/2 as the sum of a double of 33
///    bits and an interval one rounding wide. So r is an enclosure whatever k is. While |k| < 2²⁰ the product with the
///    33 bits is exact, is taken as such, and r is tight.
/// 2. Series. For r in [−1, 1] the terms of both Taylor series alternate and shrink, so what is left out is smaller
/// than
///    its first term: |r|¹⁹/19! after the term of r¹⁷, |r|¹⁸/18! after that of r¹⁶. It is computed from the upper bound
///    of |r| and added as [−e, e]. Everything is interval arithmetic, the reciprocals of the factorials too; n! is a
///    double for n ≤ 19.
/// 3. Quarter turns. sin and cos of r + k · π/2 are ± one of the two, by k mod 4.
/// 4. Width. No sine and no cosine has a slope above 1, so over the whole interval they stay within its radius of their
///    values at m; and within [−1, 1].

namespace swept::oracle {
namespace {

constexpr double kHalfPiHead = 0x1.921fb544p+0;        // the first 33 bits of π/2
constexpr double kHalfPiTail = 0x1.0b4611a626331p-34;  // nearest to the rest, which is 3.5e-27 more
constexpr double kExactQuarters = 0x1p20;              // below it the product with the head has at most 53 bits
constexpr double kLargestAngle = 1e9;                  // beyond it nothing is claimed but [−1, 1]

/// ±1/n! for the terms of one series, from the highest degree down.
template <std::size_t count>
std::array<Interval, count> coefficients(int lowestDegree) {
    std::array<Interval, count> result;
    Interval term = 1;  // 1/lowestDegree!, as lowestDegree is 0 or 1
    for (std::size_t i = 0; i < count; ++i) {
        result[count - 1 - i] = i % 2 == 0 ? term : -term;
        const double degree = lowestDegree + 2.0 * static_cast<double>(i);
        term = term / Interval((degree + 1) * (degree + 2));  // an integer below 2⁵³
    }
    return result;
}

template <std::size_t count>
Interval horner(const std::array<Interval, count>& highestFirst, Interval x) {
    Interval sum = highestFirst[0];
    for (std::size_t i = 1; i < count; ++i) { sum = sum * x + highestFirst[i]; }
    return sum;
}

/// |r| ≤ 1.
SinCos series(Interval r) {
    static const auto sines = coefficients<9>(1);    // r … r¹⁷
    static const auto cosines = coefficients<9>(0);  // 1 … r¹⁶
    constexpr double kFactorial18 = 6402373705728000;
    constexpr double kFactorial19 = 121645100408832000;
    const Interval x = square(r);
    const Interval x8 = square(square(square(x)));
    const Interval left18 = x8 * x / kFactorial18;
    const Interval left19 = x8 * x * Interval(r.magnitude()) / kFactorial19;
    return {r * horner(sines, x) + Interval::around(left19.hi), horner(cosines, x) + Interval::around(left18.hi)};
}

}  // namespace

SinCos sinCos(Interval angle) {
    constexpr Interval kAll{-1, 1};
    const double middle = angle.middle();
    if (!(angle.magnitude() < kLargestAngle)) { return {kAll, kAll}; }
    const double quarters = std::nearbyint(middle * 0.6366197723675814);
    const Interval tail{nextDown(kHalfPiTail), nextUp(kHalfPiTail)};
    const double head = quarters * kHalfPiHead;
    const Interval product = std::fabs(quarters) < kExactQuarters ? Interval(head) : Interval::outward(head, head);
    const Interval r = (Interval(middle) - product) - quarters * tail;
    if (!(r.magnitude() <= 1)) { return {kAll, kAll}; }
    SinCos result = series(r);
    const auto quadrant = static_cast<std::int64_t>(quarters) & 3;
    if (quadrant == 1) { result = {result.cos, -result.sin}; }
    if (quadrant == 2) { result = {-result.sin, -result.cos}; }
    if (quadrant == 3) { result = {-result.cos, result.sin}; }
    const Interval width = Interval::around(angle.lo == angle.hi ? 0 : angle.radius());
    return {meet(result.sin + width, kAll), meet(result.cos + width, kAll)};
}

}  // namespace swept::oracle
