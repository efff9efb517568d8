#pragma once

#include <array>
#include <span>

#include "aabb.h"
#include "status.h"
#include "transform.h"

namespace swept::inline SWEPT_PRECISION {

inline constexpr int kMaxPolygonVertices = 8;

/// The one shape of the engine: 1 to 8 vertices, convex, counter-clockwise, grown outwards by a radius. One vertex is a
/// circle, two are a segment or a capsule, more a (rounded) polygon. Coordinates in metres in the frame of the body.
/// Made by the functions below, which guarantee the invariants; `validate` checks a hand-made one.
struct Polygon {
    std::array<Vec2, kMaxPolygonVertices> vertices{};
    /// Outward unit normals: `normals[i]` belongs to the edge from vertex i to vertex i + 1 (cyclic). A segment has
    /// two, one for each side; a circle has none.
    std::array<Vec2, kMaxPolygonVertices> normals{};
    Real radius = 0;
    int count = 0;

    std::span<const Vec2> points() const { return {vertices.data(), static_cast<std::size_t>(count)}; }
    constexpr int next(int i) const { return i + 1 < count ? i + 1 : 0; }
    constexpr int previous(int i) const { return i > 0 ? i - 1 : count - 1; }
};

/// Errors of all makers: `notFinite`, `negative` (radius, half extents), `degenerate` (no extent). Any finite lengths
/// are taken here; those beyond 2⁶³ (in f64 2⁵¹¹) metres are refused when the shape is added to a world.

/// @param radius  greater than 0 (a point without radius has no extent).
Result<Polygon> makeCircle(Vec2 center, Real radius);
/// @param radius  greater than 0. Equal end points are `degenerate`.
Result<Polygon> makeCapsule(Vec2 p, Vec2 q, Real radius);
/// A capsule that may have radius 0. As a collision shape a segment has two sides.
Result<Polygon> makeSegment(Vec2 p, Vec2 q, Real radius = 0);
/// @param half    half extents, both greater than 0.
/// @param angle   radians, about `center`.
Result<Polygon> makeBox(Vec2 half, Vec2 center = {}, double angle = 0, Real radius = 0);
/// Takes 3 to 8 vertices (else `tooFewVertices`, `tooManyVertices`) that are already convex, strictly, and
/// counter-clockwise (else `notConvex`). For an arbitrary cloud of points use `convexHull` (hull.h).
Result<Polygon> makePolygon(std::span<const Vec2> vertices, Real radius = 0);

/// Outward unit normal of the edge from p to q of a counter-clockwise polygon (to the right of it); (0, 0) if p == q.
inline Vec2 edgeNormal(Vec2 p, Vec2 q) { return normalized(rightPerp(q - p)).unit; }

/// Whether a polygon fulfils the invariants above; `field` names the member that does not.
Status validate(const Polygon& polygon);

/// Smallest non-zero width of the shape, radii included: the length against which tolerances are measured. A segment
/// without radius has its length as extent. Metres, greater than 0.
Real extentOf(const Polygon& polygon);

/// World bounds of a placed polygon, radius included, rounded outward.
Aabb boundsOf(const Polygon& polygon, const WorldTransform& pose);
/// The same of all places where it is on a straight way, without turning, and as far around them as it reaches.
/// @param way    metres, from the pose on
/// @param reach  metres, not negative
Aabb boundsOf(const Polygon& polygon, const WorldTransform& pose, DVec2 way, Real reach);

/// Radius of the smallest circle about `center` (body frame) that holds the whole shape, radius included; rounded up.
Real radiusAbout(const Polygon& polygon, Vec2 center);

/// Index of the vertex farthest along `direction`; the lowest index on a tie. @pre the direction is finite
int supportIndex(const Polygon& polygon, Vec2 direction);

}  // namespace swept::inline SWEPT_PRECISION
