#include "trig.h"

#include "trig_series.h"

#include <array>
#include <cmath>
#include <numbers>

namespace swept::inline SWEPT_PRECISION {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kPiRest = 0x1.1a62633145c07p-53;  // π − kPi
constexpr double kTwoPi = 2 * kPi;

/// A number as the unevaluated sum of a rounded one and a small rest.
struct TwoParts {
    double high;
    double low;
};

/// angle − quadrant·π/2.
TwoParts reduced(double angle, double quadrant) {
    const double afterFirst = angle - quadrant * kHalfPi1;  // exact: both are multiples of the smaller one's last bit
    const double second = quadrant * kHalfPi2;
    const double afterSecond = afterFirst - second;
    const double subtracted = afterFirst - afterSecond;  // what the rounding let through of `second` (TwoSum)
    const double lost = (afterFirst - (afterSecond + subtracted)) + (subtracted - second);
    const double rest = lost - quadrant * kHalfPi3;
    const double high = afterSecond + rest;
    return {high, (afterSecond - high) + rest};
}

/// Coefficients first … last of a polynomial in z, by Horner's rule.
template <std::size_t N>
constexpr double polynomial(const std::array<double, N>& coefficients, double z) {
    double sum = coefficients[N - 1];
    for (std::size_t i = N - 1; i > 0; --i) { sum = sum * z + coefficients[i - 1]; }
    return sum;
}

/// The same for at most 8 coefficients by Estrin's scheme: pairs, then pairs of pairs. A few more products than
/// Horner's rule, but a third of its chain of roundings and of waiting for each other.
template <std::size_t N>
constexpr double polynomialInPairs(const std::array<double, N>& c, double z) {
    static_assert(N == 7 || N == 8);
    const double z2 = z * z;
    const double z4 = z2 * z2;
    const double low = (c[0] + c[1] * z) + z2 * (c[2] + c[3] * z);
    const double top = N == 8 ? c[6] + c[N - 1] * z : c[6];
    const double high = (c[4] + c[5] * z) + z2 * top;
    return low + z4 * high;
}

/// On [−π/4, π/4]; the low part enters to first order.
SinCos sinCosOfReduced(TwoParts x) {
    const double z = x.high * x.high;
    const double half = 0.5 * z;
    const double sine = x.high + (x.high * z * polynomialInPairs(kSine, z) + x.low * (1 - half));
    const double top = 1 - half;
    const double cosine = top + (((1 - top) - half) + (z * z * polynomialInPairs(kCosine, z) - x.high * x.low));
    return {sine, cosine};
}

/// Where there is no need to look for the quadrant: most bodies turn by less than that in a step.
constexpr double kSurelyReduced = 0.75;

// atan(i/8).
constexpr std::array<double, 9> kArcTangents = {0x0p+0,
                                                0x1.fd5ba9aac2f6ep-4,
                                                0x1.f5b75f92c80ddp-3,
                                                0x1.6f61941e4def1p-2,
                                                0x1.dac670561bb4fp-2,
                                                0x1.1e00babdefeb4p-1,
                                                0x1.4978fa3269ee1p-1,
                                                0x1.700a7c5784634p-1,
                                                0x1.921fb54442d18p-1};
// Taylor's polynomial of atan(u)/u in u²; for |u| ≤ 1/16 the first term left out is below 2⁻⁵⁹.
constexpr std::array<double, 7> kArcTangent = {1.0, -1.0 / 3, 1.0 / 5, -1.0 / 7, 1.0 / 9, -1.0 / 11, 1.0 / 13};

/// atan(t) for t in [0, 1] as the nearest atan(i/8) and the difference, by the addition theorem.
TwoParts arcTangentOfFraction(double t) {
    const double index = std::floor(8 * t + 0.5);
    const double center = index / 8;
    const double u = (t - center) / (1 + t * center);
    return {kArcTangents[static_cast<std::size_t>(index)], u * polynomial(kArcTangent, u * u)};
}

// ln 2 in two parts; the first has 40 bits, so its products with an exponent are exact.
constexpr double kLn2High = 0x1.62e42fefa2p-1;
constexpr double kLn2Low = 0x1.9ef35793c7673p-41;
constexpr double kOneOverLn2 = 0x1.71547652b82fep+0;
/// −ln of the smallest normal number.
constexpr double kLargestExponent = 0x1.6232bdd7abcd2p+9;

template <int kFirst, std::size_t N>
constexpr std::array<double, N> inverseFactorials(double sign) {
    std::array<double, N> result{};
    double factor = 1;
    for (std::size_t i = 0; i < N; ++i) {
        result[i] = factor / factorial(kFirst + static_cast<int>(i));
        factor *= sign;
    }
    return result;
}
// Taylor's polynomial of e^r; for |r| ≤ ½ ln 2 the first term left out, r¹⁴/14!, is below 2⁻⁵⁷.
constexpr std::array<double, 14> kExponential = inverseFactorials<0, 14>(1);
// phi2 for x ≤ 1: Σ (−x)ⁿ/(n + 2)!; the first term left out is 1/20! < 2⁻⁶¹.
constexpr std::array<double, 18> kPhi2 = inverseFactorials<2, 18>(-1);

}  // namespace

SinCos sinCos(double angle) {
    if (angle == 0) { return {angle, 1}; }  // keeps the sign of −0
    if (std::fabs(angle) < kSurelyReduced) { return sinCosOfReduced({angle, 0}); }
    if (!std::isfinite(angle)) { return {0, 1}; }
    // The C standard defines fmod without rounding, so it is the same everywhere.
    if (std::fabs(angle) > kLargestExactAngle) { angle = std::fmod(angle, kTwoPi); }
    const double quadrant = std::floor(angle * kTwoOverPi + 0.5);
    const SinCos near = quadrant == 0 ? sinCosOfReduced({angle, 0}) : sinCosOfReduced(reduced(angle, quadrant));
    // By tables: nobody can predict the quadrant of an angle, and a wrong guess costs more than all the rest.
    constexpr std::array<double, 4> kSignOfSine = {1, 1, -1, -1};
    constexpr std::array<double, 4> kSignOfCosine = {1, -1, -1, 1};
    const std::array<double, 2> both = {near.sin, near.cos};
    const auto q = static_cast<std::size_t>(static_cast<int>(quadrant) & 3);
    return {kSignOfSine[q] * both[q & 1], kSignOfCosine[q] * both[1 - (q & 1)]};
}

double arcTangent2(double y, double x) {
    if (std::isnan(x) || std::isnan(y)) { return 0; }
    const double width = std::fabs(x);
    const double height = std::fabs(y);
    if (height == 0 && width == 0) { return 0; }
    const bool steep = height > width;
    const bool bothInfinite = std::isinf(width) && std::isinf(height);
    const double fraction = bothInfinite ? 1 : (steep ? width / height : height / width);
    const TwoParts octant = arcTangentOfFraction(fraction);
    // The angle is base ± octant; all small parts are gathered first, so that only the last sum rounds visibly.
    const double halfTurns = steep ? 0.5 : (x < 0 ? 1 : 0);
    const double sign = steep == (x < 0) ? 1 : -1;
    const double base = halfTurns * kPi;
    const double high = base + sign * octant.high;
    const double lost = (base - high) + sign * octant.high;
    const double angle = high + (lost + (sign * octant.low + halfTurns * kPiRest));
    return y < 0 ? -angle : angle;
}

double expOfMinus(double x) {
    if (!(x > 0)) { return 1; }
    if (x > kLargestExponent) { return 0; }
    const double exponent = std::floor(x * kOneOverLn2 + 0.5);
    const double r = (exponent * kLn2High - x) + exponent * kLn2Low;
    return std::ldexp(polynomial(kExponential, r), -static_cast<int>(exponent));
}

DampedMotion motionWithDamping(double x) {
    const double decay = expOfMinus(x);
    if (x <= 1) {
        const double phi2 = polynomial(kPhi2, x);
        return {decay, 1 - x * phi2, phi2};
    }
    const double phi1 = (1 - decay) / x;
    return {decay, phi1, (1 - phi1) / x};
}

}  // namespace swept::inline SWEPT_PRECISION
