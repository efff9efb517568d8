#pragma once

#include "../state/profile.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// As a step of another length than the last one begins: what is held takes part again, boxes reach as far as the step
/// asks, and impulses of contacts and joints become those of its sub-steps.
void changeStep(WorldState& world, double dt);

/// The same of settings with other sub-steps than before, between two steps. @pre what is held was released
void changeSubSteps(WorldState& world, int before);

/// Of a step of another length than the one before, or after longer ones: errors go on being closed at the pace of the
/// longest of the last seconds, or nearly at that of longer ones before it.
/// @param before  length of the step before it, s, or 0
/// @return        s, dt or more
double closingTimeAfter(WorldState& world, double before, double dt);
/// Likewise after steps of fewer sub-steps. @param dt  of the step. @return  how many times that time, at least once
double closingStretchOf(const WorldState& world, double dt);

/// Of contacts and joints: a spring as stiff as sub-steps can sample. Beside a part of a step, or after steps that were
/// longer, it is that of the whole step, or of those: a stiffer one would push what it finds out within a few short
/// sub-steps, and what relaxation leaves of that is energy.
/// @param h   length of a sub-step, s
/// @param dt  of the step that it is part of, s
inline Softness softnessOfStep(const WorldState& world, Effort effort, Real cycles, Real dampingRatio, Real h,
                               Real dt) {
    const auto subSteps = static_cast<Real>(standardSubSteps(world.settings, effort));
    const Real sampled = std::max(h, dt / subSteps);
    const Real closing = std::max(sampled, static_cast<Real>(world.closingTime * world.closingStretch) / subSteps);
    return softnessOfSubStep(cycles, dampingRatio, closing, sampled);
}

}  // namespace swept::inline SWEPT_PRECISION
