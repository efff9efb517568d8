#pragma once

#include <cstddef>
#include <new>

#include "../shapes/distance.h"
#include "../shapes/gjk.h"
#include "relative_motion.h"
#include "time_of_impact.h"

namespace swept::inline SWEPT_PRECISION {

/// A polygon with the centre of mass as its origin. Without normals: what needs them makes them.
class CenteredPolygon {
public:
    CenteredPolygon(const ToiPolygon& source, DVec2 center);

    const Polygon& polygon() const { return *std::launder(reinterpret_cast<const Polygon*>(storage_.data())); }
    Vec2 vertex(int i) const { return polygon().vertices[static_cast<std::size_t>(i)]; }
    int count() const { return polygon().count; }
    /// Of the farthest vertex from the centre, metres; rounded up.
    double reach() const { return reach_; }
    /// A point inside: the mean of the vertices.
    DVec2 middle() const { return middle_; }

private:
    /// Bytes, because a `Polygon` clears itself, and that costs as much as a tenth of a query. The bytes begin the life
    /// of an aggregate whose vertices are written at once; its normals are never read.
    alignas(Polygon) std::array<std::byte, sizeof(Polygon)> storage_;
    double reach_ = 0;
    DVec2 middle_;
};

/// Whose face the closest direction is normal to: the line between two vertices belongs to the world.
enum class AxisOwner : std::uint8_t { world, a, b };

/// Where the pair stands at one fraction, in world axes.
struct PairPose {
    double fraction = 0;
    Rotation rotationA;  ///< frames of the bodies to world
    Rotation rotationB;
    Vec2 offset;  ///< centre of B minus centre of A, metres
};

/// Separation at a pose with all that goes with it, in the frame of A: origin at its centre, axes turned with it.
struct Closest {
    double separation = 0;      ///< radii included, metres
    double coreSeparation = 0;  ///< without radii; not above 0 when the cores overlap
    Vec2 normal;                ///< unit, from A to B
    AxisOwner owner = AxisOwner::world;
    GjkResult gjk;
    CorePoints exactPoints;  ///< on the rounded surfaces; only where an overlap or a touch was measured

    /// An overlap whose depth, normal and points are not measured yet: `measureOverlap` does it.
    bool isDeep() const { return gjk.encloses; }
    bool isApart() const { return gjk.outcome == GjkOutcome::apart; }
    bool coresOverlap() const { return gjk.encloses || coreSeparation <= 0; }
};

/// Two polygons and their motion: what a time-of-impact query works on.
struct MovingPair {
    CenteredPolygon a;
    CenteredPolygon b;
    RelativeMotion motion;
    double radii;    ///< both, metres
    double fastest;  ///< no less than the speed of the centres' difference anywhere in the sweep, metres per unit of
                     ///< fraction

    MovingPair(const ToiPolygon& polygonA, const Sweep& sweepA, const ToiPolygon& polygonB, const Sweep& sweepB);

    PairPose poseAt(double fraction) const;
    /// The same, from another pose: what does not turn keeps its rotation.
    void moveTo(double fraction, PairPose& pose) const;

    /// Distance at a pose. `cache` carries the simplex from one evaluation to the next. Where the cores overlap the
    /// depth is not measured: `closest.separation` is 0.
    void findClosest(const PairPose& pose, SimplexCache& cache, Closest& closest) const;
    /// Penetration, where `findClosest` found an overlap.
    void measureOverlap(const PairPose& pose, Closest& closest) const;
    /// Points on the rounded surfaces that realise the separation, frame of A.
    CorePoints witnessesOf(const PairPose& pose, const Closest& closest) const;
    Transform bInA(const PairPose& pose) const;

    /// Coordinates whose products leave the range of double.
    bool isExtreme() const { return isExtreme_; }

private:
    bool isExtreme_ = false;
};

/// How far a separation computed by this folder, or a bound on it, may be from the true one by rounding, anywhere in
/// the sweep. Metres. A-priori: a count of roundings, each relative to the largest coordinate it touches.
double roundingSlack(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB);

}  // namespace swept::inline SWEPT_PRECISION
