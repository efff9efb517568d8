#pragma once

#include <cmath>

namespace swept {

/// value + rate·s − ½·bend·s²: a lower bound of a function whose second derivative is at least −bend.
struct Parabola {
    double value = 0;
    double rate = 0;
    double bend = 0;

    constexpr double at(double s) const { return value + s * (rate - 0.5 * bend * s); }
    constexpr Parabola operator+(const Parabola& o) const { return {value + o.value, rate + o.rate, bend + o.bend}; }
};

/// First s in [0, limit] at which the parabola is 0 or below; `limit` when there is none.
inline double firstRoot(const Parabola& p, double limit) {
    if (!(p.value > 0)) { return 0; }
    const double discriminant = p.rate * p.rate + 2 * p.bend * p.value;
    if (discriminant < 0) { return limit; }  // bends upward and stays above 0
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

}  // namespace swept
