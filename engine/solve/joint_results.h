#pragma once

#include "../state/world_state.h"

/// What a solve leaves in the joints: impulses to start the next one from, and reactions.

namespace swept::inline SWEPT_PRECISION {

/// What a solve found, unless it overflowed: then its impulses, which are there already, are forgotten.
/// @param dt  that was solved
void takeReaction(Joint& joint, const JointReaction& total, Real dt);
void takeHinge(Joint& joint, const RevoluteConstraint& constraint, Real dt);

/// Impulses to start from that belong to a state that is gone, or are no numbers; and the reactions of the last step.
void forgetImpulses(Joint& joint);
/// The impulses alone.
void forgetStart(Joint& joint);
/// Takes impulses and reactions back from a solved batch.
void readConstraints(SolverBatch& batch, WorldState& world, Real dt);

}  // namespace swept::inline SWEPT_PRECISION
