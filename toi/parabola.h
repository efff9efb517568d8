#pragma once

#include <cmath>
#include <limits>

namespace swept {

/// value + rate·s − ½·bend·s²: a lower bound of a function whose second derivative is at least −bend.
struct Parabola {
    double value = 0;
    double rate = 0;
    double bend = 0;

    constexpr double at(double s) const { return value + s * (rate - 0.5 * bend * s); }
    constexpr Parabola operator+(const Parabola& o) const { return {value + o.value, rate + o.rate, bend + o.bend}; }
};

/// Below 0: it bends upward and stays above 0.
constexpr double discriminantOf(const Parabola& p) { return p.rate * p.rate + 2 * p.bend * p.value; }

/// @pre the value is above 0
inline double firstRootBy(double discriminant, const Parabola& p, double limit) {
    if (discriminant < 0) { return limit; }
    const double root = std::sqrt(discriminant);
    // Of the two forms of the solution each branch takes the one without cancellation.
    double s = limit;
    if (p.rate < 0) {
        s = 2 * p.value / (root - p.rate);
    } else if (p.bend > 0) {
        s = (p.rate + root) / p.bend;
    }
    return s < limit ? s : limit;
}

/// First s in [0, limit] at which the parabola is 0 or below; `limit` when there is none.
inline double firstRoot(const Parabola& p, double limit) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    if (!(p.value > 0)) { return 0; }
    const double discriminant = discriminantOf(p);
    if (discriminant < kInfinity) { return firstRootBy(discriminant, p, limit); }
    // Beyond 2⁵¹¹ squares overflow, and their difference is no number. The root is the same at any scale.
    constexpr double kScale = 0x1p-540;
    const Parabola scaled{kScale * p.value, kScale * p.rate, kScale * p.bend};
    const double ofScaled = discriminantOf(scaled);
    return ofScaled < kInfinity ? firstRootBy(ofScaled, scaled, limit) : 0;
}

}  // namespace swept
