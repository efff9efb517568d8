#include "obb.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Both boxes as the separating-axis test sees them.
struct Placement {
    Vec2 inA;     ///< from the centre of A to that of B, along the axes of A
    Vec2 inB;     ///< the same along the axes of B
    Real cosine;  ///< of the angle between the boxes, not negative
    Real sine;
};

Placement placementOf(const Obb& a, const Obb& b) {
    const Vec2 offset = b.pose.translation - a.pose.translation;
    const Rotation turn = inverse(a.pose.rotation) * b.pose.rotation;
    return {unrotate(a.pose.rotation, offset), unrotate(b.pose.rotation, offset), std::fabs(turn.c), std::fabs(turn.s)};
}

/// How far a box reaches along the axes of another one.
Vec2 reach(Vec2 half, const Placement& p) {
    return {p.cosine * half.x + p.sine * half.y, p.sine * half.x + p.cosine * half.y};
}

Real largestGap(const Obb& a, const Obb& b, const Placement& p) {
    const Vec2 reachOfB = reach(b.half, p);
    const Vec2 reachOfA = reach(a.half, p);
    const Real gapA =
        std::fmax(std::fabs(p.inA.x) - (a.half.x + reachOfB.x), std::fabs(p.inA.y) - (a.half.y + reachOfB.y));
    const Real gapB =
        std::fmax(std::fabs(p.inB.x) - (b.half.x + reachOfA.x), std::fabs(p.inB.y) - (b.half.y + reachOfA.y));
    return std::fmax(gapA, gapB);
}

// A gap passes through at most 8 roundings of ½ eps, each relative to the extents and the distance.
constexpr Real kGapError = 4 * kEpsilon;

}  // namespace

Real separation(const Obb& a, const Obb& b) { return largestGap(a, b, placementOf(a, b)); }

bool overlaps(const Obb& a, const Obb& b) {
    const Placement p = placementOf(a, b);
    const Real size = (a.half.x + a.half.y) + (b.half.x + b.half.y) + (std::fabs(p.inA.x) + std::fabs(p.inA.y));
    return largestGap(a, b, p) <= kGapError * size;
}

}  // namespace swept::inline SWEPT_PRECISION
