#pragma once

#include <optional>

#include "../shapes/distance.h"
#include "relative_motion.h"
#include "time_of_impact.h"

namespace swept::inline SWEPT_PRECISION {

/// A polygon with the centre of mass as its origin, ready for the distance function.
struct MethodBody {
    Polygon polygon;
    std::array<double, 8> reach{};  ///< distance of each vertex from the centre, metres

    MethodBody(const ToiPolygon& source, DVec2 center);
    double farthest() const;
};

/// Where the pair stands at one fraction, in the frame of A: origin at its centre, axes turned with it.
struct MethodPose {
    double fraction = 0;
    Rotation rotationA;  ///< frame of A to world
    Transform bInA;
    Distance distance;
};

/// What was seen at one fraction: there the pair is still apart.
struct MethodLook {
    double fraction;
    double separation;  ///< above the target, metres
};

/// Two polygons and their motion, for the methods beside the certified one. These show what an idea costs, so they
/// stand on the plain distance function; `MovingPair` is tuned for one search and changes with it.
struct MethodPair {
    MethodBody a;
    MethodBody b;
    RelativeMotion motion;

    MethodPair(const ToiPolygon& polygonA, const Sweep& sweepA, const ToiPolygon& polygonB, const Sweep& sweepB)
        : a(polygonA, sweepA.localCenter), b(polygonB, sweepB.localCenter), motion(sweepA, sweepB) {}

    double radii() const { return a.polygon.radius + b.polygon.radius; }

    /// Pose and distance at a fraction. `cache` carries the simplex from one evaluation to the next.
    MethodPose poseAt(double fraction, SimplexCache& cache) const;
};

/// The answer that a pose gives: separation, normal and witness points of that very pose, in the world; the target of
/// the settings, and no bracket (its other end is that pose, too).
Toi answerFrom(const MethodPose& pose, const Sweep& sweepA, const ToiSettings& settings, ToiState state,
               int iterations);
/// A hit with a bracket: between the pose and what was looked at before it.
Toi hitAfter(const MethodLook& before, const MethodPose& pose, const Sweep& sweepA, const ToiSettings& settings,
             int iterations);

/// What every method that looks at fraction 0 says there: `overlapped` where the cores intersect, a hit at 0 where the
/// separation is within the target; nothing otherwise.
/// @param pose  at fraction 0.
std::optional<Toi> answerAtStart(const MethodPose& pose, const Sweep& sweepA, const ToiSettings& settings);

}  // namespace swept::inline SWEPT_PRECISION
