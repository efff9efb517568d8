#pragma once

#include "../shapes/rotation.h"
#include "sweep.h"

namespace swept::inline SWEPT_PRECISION {

/// The motion of B's centre as seen from A's centre, in world axes, and both rotations. Only differences of centres are
/// kept, taken before anything else, so that nothing here depends on the distance from the origin.
struct RelativeMotion {
    DVec2 start;      ///< centre of B minus centre of A at fraction 0, metres
    DVec2 change;     ///< what the straight part of the path adds to it until fraction 1, metres
    DVec2 curvature;  ///< kB − kA, metres
    double angleA = 0;
    double angleB = 0;  ///< at fraction 0, radians
    double spinA = 0;
    double spinB = 0;  ///< radians per unit of fraction

    RelativeMotion(const Sweep& a, const Sweep& b)
        : start(b.c0 - a.c0),
          change((b.c1 - a.c1) - (b.c0 - a.c0)),
          curvature(b.k - a.k),
          angleA(a.a0),
          angleB(b.a0),
          spinA(a.a1 - a.a0),
          spinB(b.a1 - b.a0) {}

    DVec2 offsetAt(double t) const { return start + t * change + (t * (t - 1)) * curvature; }
    /// Metres per unit of fraction.
    DVec2 velocityAt(double t) const { return change + (2 * t - 1) * curvature; }
    Rotation rotationA(double t) const { return rotationFromAngle(angleA + t * spinA); }
    Rotation rotationB(double t) const { return rotationFromAngle(angleB + t * spinB); }

    /// Largest distance of the centres and largest speed between two fractions.
    double farthestWithin(double from, double to) const;
    double fastestWithin(double from, double to) const;
};

}  // namespace swept::inline SWEPT_PRECISION
