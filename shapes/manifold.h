#pragma once

#include <array>
#include <cstdint>

#include "chain.h"
#include "manifold_memory.h"
#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Names the features that made a contact point (vertex or edge indices of A and B), so that a point of this step is
/// recognised in the next. Stable as long as the same features touch.
using FeatureId = std::uint16_t;

struct ManifoldPoint {
    Vec2 point;           ///< half way between the two surfaces, frame of A
    Real separation = 0;  ///< metres along the normal, radii included; negative when penetrating
    FeatureId id = 0;
};

/// Where two shapes touch, or will within the margin.
struct Manifold {
    Vec2 normal;  ///< unit, from A to B, frame of A
    std::array<ManifoldPoint, 2> points{};
    int count = 0;             ///< 0 (farther apart than the margin), 1 or 2
    bool isNormalOfB = false;  ///< of a face of B, with which it turns; else of a face of A, or between two vertices
};

/// How near two shapes have to be.
struct ManifoldReach {
    Real points = 0;   ///< largest separation at which a point is reported, metres, at least 0
    Real nearest = 0;  ///< of the deepest point: where that is farther, none is reported; metres, at least 0
};

/// Contact manifold of any pair of polygons: closest features when the cores are apart (one point between vertices, up
/// to two where faces are parallel enough), face clipping along the axis of least penetration when they overlap.
/// @param margin  largest separation at which a point is still reported, metres, at least 0.
/// The deepest point's separation equals `distance()` up to rounding when the shapes are apart; the minimum translation
/// when they overlap, except that a face axis is preferred to a nearly equal one (by a relative tolerance) for
/// coherence.
Manifold collide(const Polygon& a, const Polygon& b, const Transform& bInA, Real margin);
/// The same manifold, bit for bit, from what the last query about the same two shapes found out, where that still
/// holds.
/// @param memory  of these two shapes in this order; empty at first
Manifold collide(const Polygon& a, const Polygon& b, const Transform& bInA, Real margin, ManifoldMemory& memory);
Manifold collide(const Polygon& a, const Polygon& b, const Transform& bInA, ManifoldReach reach,
                 ManifoldMemory& memory);

/// Against one face of A, whatever axis is shorter: the edge of B that faces it, clipped to the face; separations are
/// heights above it. Nothing is reported where no part of that edge is over the face.
/// @param sine  of the angle to the face's normal up to which a vertex beyond the end of the face still counts as over
/// it
/// @pre A has the face
Manifold collideOnFace(const Polygon& a, int face, const Polygon& b, const Transform& bInA, Real margin, Real sine);

/// `collide` for a one-sided chain segment as A. Nothing is reported when the centre of B's core lies behind the
/// segment, or where the contact belongs to a neighbour: normals outside the range that the neighbours leave open are
/// refused (convex corner) or turned to the segment's own normal (flat or concave corner), so that a body slides over
/// inner vertices without catching.
Manifold collide(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin);
Manifold collide(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin, ManifoldMemory& memory);
/// @param core  `polygonOf(a)`, of who has it at hand
Manifold collide(const ChainSegment& a, const Polygon& core, const Polygon& b, const Transform& bInA, Real margin,
                 ManifoldMemory& memory);

/// Of a manifold without points it means nothing.
inline Real deepestSeparation(const Manifold& manifold) {
    const Real first = manifold.points[0].separation;
    const std::size_t other = manifold.count < 2 ? 0 : 1;  // no branch: which it is nothing foretells
    const Real second = manifold.points[other].separation;
    return second < first ? second : first;
}

}  // namespace swept::inline SWEPT_PRECISION
