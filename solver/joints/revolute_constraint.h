#pragma once

#include "freedom_parts.h"
#include "guided_row.h"
#include "joint_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// Two bodies share a point, and may turn about it within limits, against a spring, driven by a motor.
struct RevoluteConstraint : JointConstraint, FreedomParts {
    Real baseAngle = 0;  ///< joint angle at the start of the step, rad
    Vec2 linearImpulse;  ///< accumulated; warm start in, result out. N·s per sub-step
};

void prepare(RevoluteConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<RevoluteConstraint> joints, const SolverBodies& bodies);
void solve(std::span<RevoluteConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const RevoluteConstraint& joint);

/// Distance between the two anchors now, metres.
Real anchorGap(const JointConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
