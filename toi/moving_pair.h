#pragma once

#include "../shapes/gjk.h"
#include "relative_motion.h"
#include "time_of_impact.h"

namespace swept::inline SWEPT_PRECISION {

/// A polygon with the centre of mass as its origin. Without normals: what needs them makes them.
struct CenteredPolygon {
    Polygon polygon;
    double reach = 0;  ///< of the farthest vertex from the centre, metres; rounded up

    CenteredPolygon(const ToiPolygon& source, DVec2 center);
};

/// Whose face the closest direction is normal to: the line between two vertices belongs to the world.
enum class AxisOwner : std::uint8_t { world, a, b };

/// Separation with all that goes with it, in the frame of A.
struct Closest {
    double separation = 0;      ///< radii included, metres
    double coreSeparation = 0;  ///< without radii; negative when the cores overlap
    Vec2 normal;                ///< unit, from A to B
};

/// Where the pair stands at one fraction. Everything is in the frame of A at that fraction: origin at its centre, axes
/// turned with it. The bounds need only scalar products, for which any frame will do; this one saves turning A.
struct PairPose {
    double fraction = 0;
    Rotation rotationA;  ///< frame of A to world
    Rotation rotationB;
    Transform bInA;
    Polygon turnedB;  ///< vertices of B turned into the frame of A, about B's centre
    Vec2 velocity;    ///< of B's centre relative to A's, metres per unit of fraction
    Vec2 curvature;   ///< kB − kA, metres
    Closest distance;
    AxisOwner axisOwner = AxisOwner::world;
    GjkResult gjk;
};

/// Two polygons and their motion: what a time-of-impact query works on.
struct MovingPair {
    CenteredPolygon a;
    CenteredPolygon b;
    RelativeMotion motion;

    MovingPair(const ToiPolygon& polygonA, const Sweep& sweepA, const ToiPolygon& polygonB, const Sweep& sweepB);

    double radii() const { return a.polygon.radius + b.polygon.radius; }

    /// A pose to be written by `moveTo`: what does not change from fraction to fraction is filled in.
    PairPose emptyPose() const;
    /// Pose and distance at a fraction. `cache` carries the simplex from one evaluation to the next.
    void moveTo(double fraction, PairPose& pose, SimplexCache& cache) const;
    /// The same into a pose of its own: for one-off questions.
    PairPose poseAt(double fraction, SimplexCache& cache) const;
    /// Points on the rounded surfaces that realise the separation of a pose, frame of A.
    CorePoints witnessesOf(const PairPose& pose) const;

private:
    bool isExtreme_ = false;  ///< coordinates whose products leave the range of double
};

/// How far a separation computed by this folder, or a bound on it, may be from the true one by rounding, anywhere in the
/// sweep. Metres. A-priori: a count of roundings, each relative to the largest coordinate it touches.
double roundingSlack(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB);

}  // namespace swept::inline SWEPT_PRECISION
