#pragma once

#include "freedom_parts.h"
#include "joint_constraint.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// Pulls a point of B to a target, by a spring or rigidly, with limited force: it is the sum of what the spring and its
/// damper ask for that is limited; and what has no spring comes as fast as it can still brake. Slot A is the fixed
/// world and `centerOffset` the centre of B minus the target. A target that was set elsewhere moves there within the
/// step, and what is held has its speed. (The damper of a spring is one against the world: it stays 2ζv/ω behind.)
struct MouseConstraint : JointConstraint {
    SpringGains spring;
    Real maxImpulse = 0;     ///< maximum force times sub-step, N·s; may be infinite
    Real approachRate = 0;   ///< without a spring, with limited force: speed per distance to the target, 1/s
    bool hasSpring = false;  ///< false: rigid
    Vec2 linearImpulse;      ///< accumulated; warm start in, result out. N·s per sub-step
    Vec2 springImpulse;      ///< what the spring asks for in this sub-step, N·s
    Vec2 velocity;           ///< wanted, of what comes with limited force, m/s; against the target
    Vec2 toGo;               ///< of the target in the rest of the step, metres
    Vec2 pace;               ///< of the target in this step, m/s
    Vec2 gone;               ///< by the target since `centerOffset` was taken, metres
};

void prepare(MouseConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<MouseConstraint> joints, const SolverBodies& bodies);
void solve(std::span<MouseConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const MouseConstraint& joint);

}  // namespace swept::inline SWEPT_PRECISION
