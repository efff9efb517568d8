#include "hit_event.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

Real impactSpeed(const ContactConstraint& impact) {
    return std::max(impact.points[0].bounceApproach, impact.points[1].bounceApproach);
}

ContactEvent hitOf(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB, const ContactConstraint& impact,
                   DVec2 centerB, double fraction) {
    const ContactConstraintPoint& a = impact.points[0];
    const ContactConstraintPoint& b = impact.points[1];
    const Vec2 arm = b.totalNormalImpulse > a.totalNormalImpulse ? b.anchorB : a.anchorB;
    ContactEvent hit = hitBetween(world, shapeA, shapeB);
    hit.fraction = fraction;
    hit.point = centerB + toDouble(arm);
    hit.normal = impact.normal;
    hit.approachSpeed = impactSpeed(impact);
    hit.impulse = a.totalNormalImpulse + b.totalNormalImpulse;
    return hit;
}

}  // namespace swept::inline SWEPT_PRECISION
