#pragma once

#include "../shapes/dvec2.h"

namespace swept {

/// A body's motion over a step, in world coordinates, double in both builds. At fraction t in [0, 1] the centre of mass
/// stands at c0 + t (c1 − c0) + t (t − 1) k, with k = ½·a·T² for a constant acceleration a over the time T (0: straight
/// line), and the angle is a0 + t (a1 − a0). A body-fixed point p stands at c(t) + R(angle(t)) · (p − localCenter).
struct Sweep {
    DVec2 localCenter{};  ///< centre of mass, body frame, metres
    DVec2 c0;             ///< centre at fraction 0
    DVec2 c1;             ///< centre at fraction 1
    DVec2 k{};            ///< curvature of the path, metres
    double a0 = 0;        ///< angle at fraction 0, radians; any number of turns
    double a1 = 0;
};

constexpr DVec2 centerAt(const Sweep& s, double t) { return s.c0 + t * (s.c1 - s.c0) + (t * (t - 1)) * s.k; }
constexpr double angleAt(const Sweep& s, double t) { return s.a0 + t * (s.a1 - s.a0); }

/// The part of a sweep from fraction `from` to fraction `to` (0 ≤ from < to ≤ 1) as a sweep of its own.
Sweep part(const Sweep& sweep, double from, double to);

}  // namespace swept
