#pragma once

#include "rounding.h"
#include "transform.h"

namespace swept::inline SWEPT_PRECISION {

/// Axis-aligned bounding box in world coordinates. In f32 a box made from double coordinates is rounded outward, so it
/// always contains what it bounds, as far from the origin as that may be.
struct Aabb {
    Vec2 lower;
    Vec2 upper;

    constexpr bool operator==(const Aabb&) const = default;
};
static_assert(sizeof(Aabb) == 4 * sizeof(Real), "a pair test loads a box as four lanes");

/// Touching boxes overlap.
constexpr bool overlaps(const Aabb& a, const Aabb& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
}
/// At once: which side is outgrown nothing foretells.
constexpr bool contains(const Aabb& outer, const Aabb& inner) {
    return (int{outer.lower.x <= inner.lower.x} & int{outer.lower.y <= inner.lower.y} &
            int{inner.upper.x <= outer.upper.x} & int{inner.upper.y <= outer.upper.y}) != 0;
}
constexpr Aabb hullOf(const Aabb& a, const Aabb& b) { return {(min)(a.lower, b.lower), (max)(a.upper, b.upper)}; }
constexpr Real perimeter(const Aabb& a) { return 2 * ((a.upper.x - a.lower.x) + (a.upper.y - a.lower.y)); }
/// Finite, and lower ≤ upper in both axes.
inline bool isValid(const Aabb& a) {
    return isFinite(a.lower) && isFinite(a.upper) && a.lower.x <= a.upper.x && a.lower.y <= a.upper.y;
}

/// The smallest `Aabb` of `Real` that contains [lower, upper]: each bound is rounded outward. Bounds beyond the range
/// of `Real` become its largest finite values.
constexpr Aabb roundedOutward(DVec2 lower, DVec2 upper) {
    const double exact[4] = {lower.x, lower.y, -upper.x, -upper.y};
    Real down[4] = {};
    for (int i = 0; i < 4; ++i) { down[i] = roundedDown(exact[i]); }
    return {{down[0], down[1]}, {-down[2], -down[3]}};
}

/// The box grown by `margin` ≥ 0 metres on every side (rounded outward).
constexpr Aabb grown(const Aabb& a, Real margin) {
    const Real bounds[4] = {a.lower.x, a.lower.y, -a.upper.x, -a.upper.y};
    Real down[4] = {};
    for (int i = 0; i < 4; ++i) { down[i] = sumRoundedDown(bounds[i], -margin); }
    return {{down[0], down[1]}, {-down[2], -down[3]}};
}

struct RayHit {
    bool hit = false;
    Real fraction = 0;  ///< along the ray, 0 … maxFraction; 0 when the origin is inside
};

/// Ray origin + t·direction, 0 ≤ t ≤ maxFraction, against a box (slab method). Conservative: rounding never loses a hit
/// of a box that the exact ray meets.
RayHit rayCast(const Aabb& box, DVec2 origin, DVec2 direction, Real maxFraction);

}  // namespace swept::inline SWEPT_PRECISION
