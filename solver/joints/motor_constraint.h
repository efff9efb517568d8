#pragma once

#include "freedom_parts.h"
#include "joint_constraint.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// A hinge of the two bodies that a motor joint turns: that leaves its point as it is, or what the turn does to the
/// point comes back in the next sub-step, larger. The hinge does not know of it, so this is kept here.
struct HingeBeside {
    Vec2 armA;  ///< of the point, as anchors are
    Vec2 armB;
    bool isThere = false;
    bool isReversed = false;   ///< its A is B
    std::uint32_t source = 0;  ///< the engine's name for it
    Real guided = 0;  ///< of the angular impulse: what the point was held against here, N·m·s; of each sub-step
    Vec2 impulse;     ///< that it took, on B, N·s
    Vec2 total;       ///< over the step
};

/// Drives B relative to A to a pose or with a velocity, with limited force and torque. A's anchor is where B's is to be
/// (pose), or where it is now (velocity). Towards a pose the speed falls with the distance, and is never more than the
/// force can stop within it, √(2·a·distance): a load that the motor can bear comes to rest there without overshooting.
struct MotorConstraint : JointConstraint {
    Real baseAngle = 0;          ///< angle of B relative to A beyond the wanted one, at the start of the step, rad
    Vec2 velocity;               ///< wanted velocity of B's anchor relative to A, m/s
    Real spin = 0;               ///< wanted spin of B relative to A, rad/s
    Real approachRate = 0;       ///< speed per distance towards a pose, 1/s
    Real ease = 0;               ///< of a sub-step: part of its impulse that it gives way by, see `kDriveGive`
    Real maxLinearImpulse = 0;   ///< maximum force times sub-step, N·s
    Real maxAngularImpulse = 0;  ///< maximum torque times sub-step, N·m·s
    bool drivesLine = false;     ///< whether there is a linear drive at all
    bool drivesAngle = false;
    bool seeksPlace = false;  ///< the linear drive: a place (true) or a velocity
    bool seeksAngle = false;
    Vec2 linearImpulse;       ///< accumulated; warm start in, result out. N·s per sub-step
    Real angularImpulse = 0;  ///< N·m·s
    HingeBeside hinge;
};

/// Wanted velocities of what seeks a pose, once per sub-step: they are real, and stay what they are in relaxation.
/// @param h  of the sub-step, s
void aimDrive(MotorConstraint& joint, const JointPair& pair, Real h);

void prepare(MotorConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<MotorConstraint> joints, const SolverBodies& bodies);
void solve(std::span<MotorConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const MotorConstraint& joint);
void addUpReactions(std::span<MotorConstraint> joints);

}  // namespace swept::inline SWEPT_PRECISION
