#pragma once

#include "../shapes/distance.h"
#include "relative_motion.h"
#include "time_of_impact.h"

namespace swept::inline SWEPT_PRECISION {

/// A polygon with the centre of mass as its origin, ready for the distance function.
struct CenteredPolygon {
    Polygon polygon;
    std::array<double, 8> reach{};  ///< distance of each vertex from the centre, metres

    CenteredPolygon(const ToiPolygon& source, DVec2 center);
};

/// Where the pair stands at one fraction. Everything is in the frame of A at that fraction: origin at its centre, axes
/// turned with it. The bounds need only scalar products, for which any frame will do; this one saves turning A.
struct PairPose {
    double fraction = 0;
    Rotation rotationA;  ///< frame of A to world
    Transform bInA;
    Vec2 velocity;   ///< of B's centre relative to A's, metres per unit of fraction
    Vec2 curvature;  ///< kB − kA, metres
    Distance distance;
};

/// Two polygons and their motion: what a time-of-impact query works on.
struct MovingPair {
    CenteredPolygon a;
    CenteredPolygon b;
    RelativeMotion motion;

    MovingPair(const ToiPolygon& polygonA, const Sweep& sweepA, const ToiPolygon& polygonB, const Sweep& sweepB)
        : a(polygonA, sweepA.localCenter), b(polygonB, sweepB.localCenter), motion(sweepA, sweepB) {}

    double radii() const { return a.polygon.radius + b.polygon.radius; }

    /// Pose and distance at a fraction. `cache` carries the simplex from one evaluation to the next.
    PairPose poseAt(double fraction, SimplexCache& cache) const;
};

/// How far a separation computed by this folder, or a bound on it, may be from the true one by rounding, anywhere in the
/// sweep. Metres. A-priori: a count of roundings, each relative to the largest coordinate it touches.
double roundingSlack(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB);

}  // namespace swept::inline SWEPT_PRECISION
