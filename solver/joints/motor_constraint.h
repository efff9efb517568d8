#pragma once

#include "freedom_parts.h"
#include "joint_constraint.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// Drives B relative to A to a pose or with a velocity, with limited force and torque. A's anchor is where B's is to be
/// (pose), or where it is now (velocity). Towards a pose the speed falls with the distance, and is never more than the
/// force can stop within it, √(2·a·distance): a load that the motor can bear comes to rest there without overshooting.
struct MotorConstraint : JointConstraint {
    Real baseAngle = 0;          ///< angle of B relative to A beyond the wanted one, at the start of the step, rad
    Vec2 velocity;               ///< wanted velocity of B's anchor relative to A, m/s
    Real spin = 0;               ///< wanted spin of B relative to A, rad/s
    Real approachRate = 0;       ///< speed per distance towards a pose, 1/s
    Real maxLinearImpulse = 0;   ///< maximum force times sub-step, N·s
    Real maxAngularImpulse = 0;  ///< maximum torque times sub-step, N·m·s
    bool drivesLine = false;     ///< whether there is a linear drive at all
    bool drivesAngle = false;
    bool seeksPlace = false;  ///< the linear drive: a place (true) or a velocity
    bool seeksAngle = false;
    Vec2 linearImpulse;       ///< accumulated; warm start in, result out. N·s per sub-step
    Real angularImpulse = 0;  ///< N·m·s
};

void prepare(MotorConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<MotorConstraint> joints, const SolverBodies& bodies);
void solve(std::span<MotorConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const MotorConstraint& joint);

}  // namespace swept::inline SWEPT_PRECISION
