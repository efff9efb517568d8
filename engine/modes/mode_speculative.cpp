#include "../bodies/world_boxes.h"
#include "../state/tolerances.h"
#include "modes.h"

namespace swept::inline SWEPT_PRECISION {

void reachAhead(WorldState& world) {
    for (const std::uint32_t slot : world.awake) {
        const bool ahead = modeOf(world, world.bodies[slot]) == ContinuousMode::speculative;
        if (ahead) { updateProxies(world, slot); }
    }
}

void anchorAtCores(ContactConstraint& constraint, Real radiusA, Real radiusB) {
    constraint.radiusA = constraint.radiusB = 0;  // no arm is longer than to the core
    for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i) {
        ContactConstraintPoint& point = constraint.points[i];
        const Real half = point.baseSeparation / 2;
        point.anchorA -= (half + radiusA) * constraint.normal;
        point.anchorB += (half + radiusB) * constraint.normal;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
