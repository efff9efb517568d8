#pragma once

#include "../state/world_state.h"
#include "joint_place.h"

namespace swept::inline SWEPT_PRECISION {

/// Adds the constraint of a joint to the batch: with the slots and arms of the present poses and warm-start impulses. A
/// filter has none. @param source  slot of the joint; @param h  length of a sub-step; @param dt  of the step
/// @param left  of the step, when the solve begins
void addConstraint(SolverBatch& batch, const WorldState& world, std::uint32_t source, Real h, Real dt, Real left);

/// The same of hinges, one by one (tied_hinges.h): the whole constraint, or what it has beside its point.
/// @param angle  of the joint now, from where its spring pulls to, rad
RevoluteConstraint hingeConstraint(const WorldState& world, std::uint32_t source, Real h, Real dt, Real left);
FreedomParts hingeParts(const Joint& joint, Real angle, Real h, Real dt);

/// Of what joints hold. @param effort  of the bodies
Softness jointSoftness(const WorldState& world, Effort effort, Real h, Real dt);

/// Of all that it holds; limits of angles and translations do not count.
JointErrors errorsOf(const WorldState& world, const Joint& joint);

}  // namespace swept::inline SWEPT_PRECISION
