#pragma once

#include "freedom_parts.h"
#include "guided_row.h"
#include "joint_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// B's anchor slides along an axis that is fixed in A, on a spring and within limits, while B turns freely or by a
/// motor: a wheel with its suspension.
struct WheelConstraint : JointConstraint {
    Vec2 axis{0, 1};           ///< unit, world, at the start of the step; turns with A
    FreedomParts suspension;   ///< along the axis; without motor, and its gains are those of the spring as it stands
    TurningSpring spring;      ///< of the suspension
    Real motorSpeed = 0;       ///< of B relative to A, rad/s
    Real maxMotorImpulse = 0;  ///< maximum torque times sub-step, N·m·s
    bool hasMotor = false;
    /// Accumulated; warm start in, result out. Per sub-step.
    Real motorImpulse = 0;  ///< N·m·s
    Vec2 heldImpulse;       ///< across the axis, N·s; y is not used
    Vec2 axisNow{0, 1};     ///< in the last sub-step
};

void prepare(WheelConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<WheelConstraint> joints, const SolverBodies& bodies);
void solve(std::span<WheelConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const WheelConstraint& joint);

/// Distance of B's anchor from the axis now, metres.
Real axisGap(const WheelConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
