#pragma once

#include <algorithm>
#include <cstdint>

#include "../../broadphase/broadphase.h"
#include "../../shapes/chain.h"
#include "../../shapes/polygon.h"
#include "../shape_def.h"
#include "no_index.h"

namespace swept::inline SWEPT_PRECISION {

inline constexpr auto kNoProxy = static_cast<ProxyId>(kNoIndex);

/// A convex polygon on a body, or one segment of a chain. The segments of a chain are shapes of their own, linked in
/// order; the first one carries the id that the user knows.
struct Shape {
    Polygon polygon;       ///< what collides; of a chain segment: the segment as two-sided polygon
    ChainSegment segment;  ///< only when `isChainSegment`
    ShapeDef def;
    Real extent = 0;
    Real size = 0;    ///< largest coordinate of a vertex plus radius: what the rounding of its poses is relative to
    Real radius = 0;  ///< farthest point from the body's centre of mass
    std::uint32_t body = kNoIndex;
    std::uint32_t head = kNoIndex;  ///< slot of the shape that the user knows
    std::uint32_t nextInChain = kNoIndex;
    std::uint32_t segmentIndex = 0;  ///< in its chain
    ProxyId proxy = kNoProxy;        ///< none while its body is disabled
    bool isChainSegment = false;
    bool isBatched = false;  ///< `collidesInBatches`
    bool isLine = false;     ///< of no thickness: the radius of `polygon`, if it has one, is a skin (line_skin.h)
    bool isPiece = false;    ///< flush with another one of the same dynamic body, or was (flush_pieces.h)
    ClosedEnds closedEnds;   ///< of a chain segment
};

/// What slop, slack and tolerances of a pair are parts of, metres: of two lines their skin, which is all that they
/// have.
inline Real extentOfPair(const Shape& a, const Shape& b) {
    const Real skin = a.isLine && b.isLine ? 2 * std::max(a.polygon.radius, b.polygon.radius) : Real(0);
    return skin > 0 ? skin : std::min(a.extent, b.extent);
}

/// Both run clockwise, and so apart from each other where they touch, like two gears.
inline Real mixedSpeed(const ShapeDef& a, const ShapeDef& b) { return a.surfaceSpeed + b.surfaceSpeed; }

/// Of the shape that rolls on the other one, metres. A circle does, whatever the other's corners are rounded by; of two
/// the smaller one, as a pebble on a boulder as large as a hill.
inline Real rollingRadius(const Polygon& a, const Polygon& b) {
    const bool isCircleA = a.count == 1;
    const bool isCircleB = b.count == 1;
    if (isCircleA && isCircleB) { return std::min(a.radius, b.radius); }
    if (isCircleA || isCircleB) { return isCircleA ? a.radius : b.radius; }
    return std::max(a.radius, b.radius);
}
/// Metres: the impulse of a torque that resists rolling, by the normal impulse.
inline Real mixedRolling(const Shape& a, const Shape& b) {
    const Real coefficient = std::max(a.def.rollingResistance, b.def.rollingResistance);
    return coefficient > 0 ? coefficient * rollingRadius(a.polygon, b.polygon) : Real(0);
}

/// Of a contact.
struct MixedSurface {
    Real friction = 0;
    Real restitution = 0;
    Real speed = 0;    ///< of the surfaces, of that of A less that of B, along `rightPerp` of the normal, m/s
    Real rolling = 0;  ///< `mixedRolling`, of who solves for it
};
inline MixedSurface mixedSurface(const ShapeDef& a, const ShapeDef& b) {
    return {mixedFriction(a, b), mixedRestitution(a, b), mixedSpeed(a, b)};
}

}  // namespace swept::inline SWEPT_PRECISION
