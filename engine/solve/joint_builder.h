#pragma once

#include "../state/step_part.h"
#include "../state/world_state.h"
#include "joint_place.h"

namespace swept::inline SWEPT_PRECISION {

/// Of what is solved, a part of the step or all of it. Seconds.
struct SolveTimes {
    Real h;       ///< of a sub-step
    Real length;  ///< of all sub-steps
    Real left;    ///< of the step, when the first of them begins
    Real dt;      ///< of the step

    SolveTimes(const StepPart& part, Real subStep)
        : h(subStep),
          length(static_cast<Real>(part.length)),
          left(static_cast<Real>(part.dt - part.begin)),
          dt(static_cast<Real>(part.dt)) {}
};

/// Adds the constraint of a joint to the batch: with the slots and arms of the present poses and warm-start impulses. A
/// filter has none. @param source  slot of the joint
void addConstraint(SolverBatch& batch, const WorldState& world, std::uint32_t source, const SolveTimes& times);

/// The same of hinges, one by one (tied_hinges.h): the whole constraint, or what it has beside its point.
/// @param angle  of the joint now, from where its spring pulls to, rad
RevoluteConstraint hingeConstraint(const WorldState& world, std::uint32_t source, const SolveTimes& times);
FreedomParts hingeParts(const Joint& joint, Real angle, const SolveTimes& times);

/// Of what joints hold. @param effort  of the bodies
Softness jointSoftness(const WorldState& world, Effort effort, Real h, Real dt);

/// Of all that it holds; limits of angles and translations do not count.
JointErrors errorsOf(const WorldState& world, const Joint& joint);

}  // namespace swept::inline SWEPT_PRECISION
