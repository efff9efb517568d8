#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "../../shapes/status.h"
#include "../../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// @pre n is at least 0, and not beyond double
constexpr double powerOfTwo(int n) { return n == 0 ? 1.0 : 2.0 * powerOfTwo(n - 1); }

/// Largest power of two whose square, and a sum of a few of those, is still a number of `Real`: 2⁶³ or 2⁵¹¹. Nothing
/// beyond it is taken from the user but limits and strengths of joints, and no body is let go there, so what is
/// computed from positions and velocities stays finite as long as it is of second degree.
inline constexpr int kLargestExponent = std::numeric_limits<Real>::max_exponent / 2 - 1;
inline constexpr double kLargestNumber = powerOfTwo(kLargestExponent);

/// False for NaN, too.
inline bool isInRange(double x) { return std::fabs(x) <= kLargestNumber; }
inline bool isInRange(DVec2 v) { return isInRange(v.x) && isInRange(v.y); }
inline bool isInRange(Vec2 v) { return isInRange(toDouble(v)); }

/// The nearest numbers of `Real`, all of them finite. @pre x is no NaN
inline Real nearestReal(double x) {
    constexpr auto kMost = static_cast<double>((std::numeric_limits<Real>::max)());
    return static_cast<Real>(std::clamp(x, -kMost, kMost));
}
inline Vec2 nearestReal(DVec2 v) { return {nearestReal(v.x), nearestReal(v.y)}; }

/// What has one beyond all numbers is as good as nothing.
inline bool hasInverse(double x) { return x > 0 && 1 / x <= static_cast<double>(std::numeric_limits<Real>::max()); }

inline Status checkNumber(double x, const char* field) {
    if (!std::isfinite(x)) { return {StatusCode::notFinite, field}; }
    if (!isInRange(x)) { return {StatusCode::outOfRange, field}; }
    return Status::success();
}
inline Status checkNumber(DVec2 v, const char* field) {
    const Status status = checkNumber(v.x, field);
    return status.ok() ? checkNumber(v.y, field) : status;
}
inline Status checkNumber(Vec2 v, const char* field) { return checkNumber(toDouble(v), field); }

/// The first of some checks that refuses, or success.
inline Status firstFault(std::initializer_list<Status> checks) {
    for (const Status& status : checks) {
        if (!status.ok()) { return status; }
    }
    return Status::success();
}

}  // namespace swept::inline SWEPT_PRECISION
