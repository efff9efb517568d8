#pragma once

#include <vector>

#include "solver.h"

/// What is done to the constraints of a batch before a solve, and after its sub-steps.

namespace swept::inline SWEPT_PRECISION {

/// Whether a direct solve has contacts in view: they stand in no blocks.
constexpr bool looksAtContacts(DirectScope scope) { return scope == DirectScope::all || scope == DirectScope::jointed; }
/// Bounces and direct solves look at contacts one by one. Of a store, what bounces is alone, and prepared there.
bool needsContactsPrepared(const SolverBatch& batch, const SolverSettings& settings);
/// Masses, and nothing added up yet.
void prepareJoints(SolverBatch& batch);
/// Whether contacts of a batch of rigid joints are few enough for scope `jointed`, and none of these tied to the
/// ground, where contacts may contradict them.
bool mayBeJointed(const SolverBatch& batch);
/// Around a direct solve, iteration must leave in place what that found: constraints that do not give.
void makeContactsRigid(SolverBatch& batch, DirectScope scope);
void makeJointsRigid(SolverBatch& batch);
/// Those of a sub-step to the totals.
void addUpImpulses(std::vector<ContactConstraint>& contacts);

}  // namespace swept::inline SWEPT_PRECISION
