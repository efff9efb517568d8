#pragma once

#include <optional>
#include <span>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// One edge of a chain, from p to q, solid on its left-hand side and colliding on its right-hand side: the ground is
/// listed from right to left, a counter-clockwise loop is solid inside. It knows its neighbours (`before` → p and
/// q → `after`), so that nothing catches on an inner vertex. A missing neighbour (end of an open chain) is flagged.
struct ChainSegment {
    Vec2 before;
    Vec2 p;
    Vec2 q;
    Vec2 after;
    Real radius = 0;
    bool hasBefore = false;
    bool hasAfter = false;
};

/// Where an open chain goes on as another one, as a level does that is loaded piece by piece: the next points there,
/// beyond its first and its last one. Nothing catches where the two meet; what lies beyond is the other chain's.
struct ChainNeighbours {
    std::optional<Vec2> before{};
    std::optional<Vec2> after{};
};

/// The segment as a two-sided polygon (for bounds, distance, ray casts, TOI).
Polygon polygonOf(const ChainSegment& segment);

/// Outward (colliding side) unit normal: to the right of p → q.
Vec2 normalOf(const ChainSegment& segment);

/// The normal along which the segment pushes out what is in it, of those that its neighbours leave to it: `normal` if
/// it is one of them; else that of the neighbour, at an inner vertex that juts out; else its own. @param normal  unit
Vec2 outwardNormal(const ChainSegment& segment, Vec2 normal);

/// Ends at which there is a neighbour that turns away, or hardly turns: a shape beyond such an end is its neighbour's.
struct ClosedEnds {
    bool atStart = false;
    bool atEnd = false;
};
ClosedEnds closedEndsOf(const ChainSegment& segment);

/// Number of segments of a chain of `pointCount` points.
constexpr int chainSegmentCount(int pointCount, bool loop) { return loop ? pointCount : pointCount - 1; }

/// Checks the points of a chain: at least 2 (loop: 3), all finite, and so the ways between them, no two consecutive
/// ones equal, radius finite and ≥ 0; likewise the neighbours, none equal to the end beside it, and none of a loop.
Status validateChain(std::span<const Vec2> points, bool loop, Real radius, const ChainNeighbours& neighbours = {});

/// The i-th segment (0 ≤ i < chainSegmentCount) of a valid chain.
ChainSegment chainSegment(std::span<const Vec2> points, bool loop, Real radius, int i,
                          const ChainNeighbours& neighbours = {});

}  // namespace swept::inline SWEPT_PRECISION
