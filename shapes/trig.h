#pragma once

/// Trigonometry and the exponential of the step path. The C library's results differ between systems; these use only
/// IEEE 754 additions, multiplications, divisions, comparisons and exact remainders, so they give the same bits
/// everywhere. Double in both builds, compiled once per build. The bounds are measured by tests/shapes/trig_test.cpp.
///
/// Method: Cody–Waite reduction by multiples of π/2 in three parts, then Taylor polynomials on [−π/4, π/4].

#include "real.h"

namespace swept::inline SWEPT_PRECISION {

struct SinCos {
    double sin;
    double cos;
};

/// Sine and cosine of an angle in radians. Absolute error below 2⁻⁵³ for |angle| ≤ 2²⁰; beyond that the
/// reduction adds |angle|·2⁻⁵³, which is the uncertainty of the angle itself. Odd and even exactly; next to a multiple
/// of π/2 the small one of the two keeps its own digits (down to 2⁻⁹⁷). Not finite in → 0 and 1.
SinCos sinCos(double angle);

/// Angle of (x, y) in (−π, π]; 0 for (0, 0) and for NaN; zeros have no sign, infinities
/// are limits. Absolute error below 2⁻⁵¹.
double arcTangent2(double y, double x);

/// e^−x for x ≥ 0; relative error below 2⁻⁵²; 0 where the result would be subnormal; 1 for NaN and x < 0.
double expOfMinus(double x);

/// What damping at a constant rate does within a time: solutions of v′ = a − c·v. With x = c·t ≥ 0:
/// `decay` = e^−x, `phi1` = (1 − e^−x)/x, `phi2` = (x − 1 + e^−x)/x²; the limits 1, 1 and ½ at x = 0. Then
/// v(t) = decay·v₀ + phi1·a·t and c(t) = c₀ + phi1·v₀·t + phi2·a·t². Relative error below 2⁻⁵⁰, also for small x.
struct DampedMotion {
    double decay;
    double phi1;
    double phi2;
};
DampedMotion motionWithDamping(double x);  ///< @pre x > 0
/// The limits for x ≤ 0 and NaN: without damping it costs nothing.
inline DampedMotion dampedMotion(double x) { return x > 0 ? motionWithDamping(x) : DampedMotion{1, 1, 0.5}; }

}  // namespace swept::inline SWEPT_PRECISION
