#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

/// Interval arithmetic for the oracle: every operation returns an interval that holds all results that its operands
/// allow in exact arithmetic.

namespace swept::oracle {

/// The next double above; infinity stays. As `std::nextafter(x, ∞)`, which is a call: neighbours of one sign are
/// neighbours as integers.
inline double nextUp(double x) {
    if (!(x < std::numeric_limits<double>::infinity())) { return x; }  // also NaN
    const auto bits = std::bit_cast<std::int64_t>(x + 0.0);            // −0 becomes +0
    return std::bit_cast<double>(bits + (bits >= 0 ? 1 : -1));
}

inline double nextDown(double x) { return -nextUp(-x); }

/// A closed interval [lo, hi]. Basic operations of IEEE 754 (and `sqrt`) return the double nearest to the exact result,
/// which therefore lies between the neighbours of what they return: going one double outward after every operation is
/// enough, and needs no rounding mode. Where an operation overflows or has no answer a bound becomes infinite or NaN;
/// every question asked of the result (`above`, `below`) then is answered no.
struct Interval {
    double lo = 0;
    double hi = 0;

    constexpr Interval() = default;
    constexpr Interval(double exact) : lo(exact), hi(exact) {}  // NOLINT: a double is an interval
    constexpr Interval(double low, double high) : lo(low), hi(high) {}

    static Interval outward(double low, double high) { return {nextDown(low), nextUp(high)}; }
    /// [−radius, radius], radius ≥ 0.
    static constexpr Interval around(double radius) { return {-radius, radius}; }

    double middle() const { return lo + 0.5 * (hi - lo); }
    /// No point of the interval is farther than this from `middle()`.
    double radius() const { return std::max(nextUp(middle() - lo), nextUp(hi - middle())); }
    /// Largest absolute value.
    double magnitude() const { return std::max(std::fabs(lo), std::fabs(hi)); }
    bool contains(double x) const { return lo <= x && x <= hi; }
    bool above(double x) const { return lo > x; }
    bool below(double x) const { return hi < x; }
};

inline Interval operator-(Interval a) { return {-a.hi, -a.lo}; }
inline Interval operator+(Interval a, Interval b) { return Interval::outward(a.lo + b.lo, a.hi + b.hi); }
inline Interval operator-(Interval a, Interval b) { return Interval::outward(a.lo - b.hi, a.hi - b.lo); }

inline Interval operator*(Interval a, Interval b) {
    const double p = a.lo * b.lo;
    const double q = a.lo * b.hi;
    const double r = a.hi * b.lo;
    const double s = a.hi * b.hi;
    return Interval::outward(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}

/// Everything when the divisor holds 0.
inline Interval operator/(Interval a, Interval b) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (b.contains(0)) { return {-kInfinity, kInfinity}; }
    const double p = a.lo / b.lo;
    const double q = a.lo / b.hi;
    const double r = a.hi / b.lo;
    const double s = a.hi / b.hi;
    return Interval::outward(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
}

/// Of the part that is not negative.
inline Interval sqrt(Interval a) {
    return {std::max(0.0, nextDown(std::sqrt(std::max(0.0, a.lo)))), nextUp(std::sqrt(std::max(0.0, a.hi)))};
}

/// Tighter than a·a: never negative.
inline Interval square(Interval a) {
    const double far = a.magnitude();
    const double near = a.contains(0) ? 0 : std::min(std::fabs(a.lo), std::fabs(a.hi));
    return {std::max(0.0, nextDown(near * near)), nextUp(far * far)};
}

/// What lies in both, for two enclosures of one number.
inline Interval meet(Interval a, Interval b) { return {std::max(a.lo, b.lo), std::min(a.hi, b.hi)}; }

/// The smallest interval that holds both.
inline Interval join(Interval a, Interval b) { return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)}; }

struct SinCos {
    Interval sin;
    Interval cos;
};

/// Enclosures of sine and cosine of all angles of an interval, radians. See interval.cpp for the proof.
SinCos sinCos(Interval angle);

inline Interval sin(Interval angle) { return sinCos(angle).sin; }
inline Interval cos(Interval angle) { return sinCos(angle).cos; }

struct IntervalVec {
    Interval x;
    Interval y;
};

inline IntervalVec operator+(IntervalVec a, IntervalVec b) { return {a.x + b.x, a.y + b.y}; }
inline IntervalVec operator-(IntervalVec a, IntervalVec b) { return {a.x - b.x, a.y - b.y}; }
inline IntervalVec operator*(Interval s, IntervalVec a) { return {s * a.x, s * a.y}; }
inline Interval dot(IntervalVec a, IntervalVec b) { return a.x * b.x + a.y * b.y; }
inline Interval length(IntervalVec a) { return sqrt(square(a.x) + square(a.y)); }
/// A quarter turn to the left.
inline IntervalVec leftOf(IntervalVec a) { return {-a.y, a.x}; }
inline IntervalVec turned(SinCos by, IntervalVec a) {
    return {by.cos * a.x - by.sin * a.y, by.sin * a.x + by.cos * a.y};
}
/// The other way round.
inline IntervalVec turnedBack(SinCos by, IntervalVec a) {
    return {by.cos * a.x + by.sin * a.y, by.cos * a.y - by.sin * a.x};
}

}  // namespace swept::oracle
