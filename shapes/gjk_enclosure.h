#pragma once

#include <utility>

#include "gjk_run.h"

namespace swept::inline SWEPT_PRECISION::gjk {

/// Portals tried before the question is left to GJK.
inline constexpr int kMaxPortals = 3;

/// Whether the cores overlap beyond doubt: a triangle of three points of the Minkowski difference holds the origin. The
/// first point is deep inside, the second is where the vertices face each other, the third the farthest on the side
/// of the origin; as long as the origin lies beyond an edge, that edge's farthest point takes the place of a corner, as
/// in G. Snethen's portal refinement (2008). No proof, no answer: the cores may still overlap.
/// @param facing  the vertices that face each other.
/// @param insideA, insideB  any points of the shapes, each in its own frame; the nearer the middle the better.
/// @param extent  no less than any coordinate of a point of the difference or of what it is made of, metres.
inline bool provesOverlap(const PairView& pair, const Features& facing, DVec2 insideA, DVec2 insideB, double extent) {
    DVec2 to = pair.vertexB(facing.b) - pair.vertexA(facing.a);
    if (!(dot(to, pair.translation) <= 0)) {
        return false;  // apart already
    }
    DVec2 from = (pair.toA(insideB) + pair.translation) - insideA;
    // The cross products lose what their points' coordinates do, times the other's length, and a rounding of their own.
    const double margin = 16 * kResolution * extent * extent;
    double side = cross(from, to);
    for (int i = 0; i < kMaxPortals; ++i) {
        if (side < 0) {  // counter-clockwise as seen from the origin
            std::swap(from, to);
            side = -side;
        }
        const DVec2 towardsOrigin = leftPerp(to - from);
        const int a = FacingVertex::along(pair.a, toReal(-towardsOrigin));
        const int b = FacingVertex::along(pair.b, toReal(pair.toB(towardsOrigin)));
        const DVec2 next = pair.vertexB(b) - pair.vertexA(a);
        if (!(dot(towardsOrigin, next) > 0)) {
            return false;  // apart along this direction
        }
        const double ahead = cross(to, next);
        const double behind = cross(next, from);
        if (side > margin && ahead > margin && behind > margin) { return true; }
        if (ahead < behind) {
            from = next;
            side = -ahead;
        } else {
            to = next;
            side = -behind;
        }
    }
    return false;
}

}  // namespace swept::inline SWEPT_PRECISION::gjk
