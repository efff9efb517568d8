#pragma once

#include "joint_constraint.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// Pulls a point of B to a target, by a spring or rigidly, with limited force. Slot A is the fixed world and
/// `centerOffset` the centre of B minus the target.
struct MouseConstraint : JointConstraint {
    SpringGains spring;
    Real maxImpulse = 0;     ///< maximum force times sub-step, N·s; may be infinite
    bool hasSpring = false;  ///< false: rigid
    Vec2 linearImpulse;      ///< accumulated; warm start in, result out. N·s per sub-step
};

void prepare(MouseConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<MouseConstraint> joints, const SolverBodies& bodies);
void solve(std::span<MouseConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const MouseConstraint& joint);

}  // namespace swept::inline SWEPT_PRECISION
