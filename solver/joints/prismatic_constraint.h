#pragma once

#include "freedom_parts.h"
#include "guided_row.h"
#include "joint_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// B slides along an axis that is fixed in A, without turning relative to A: within limits, against a spring, driven by
/// a motor. The translation is that of B's anchor from A's, along the axis.
struct PrismaticConstraint : JointConstraint, FreedomParts {
    Vec2 axis{1, 0};     ///< unit, world, at the start of the step; turns with A
    Real baseAngle = 0;  ///< angle of B relative to A at the start of the step, rad; held at 0
    Vec2 heldImpulse;    ///< across the axis, N·s, and of the angle, N·m·s; accumulated as the others
    Vec2 axisNow{1, 0};  ///< in the last sub-step
};

void prepare(PrismaticConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<PrismaticConstraint> joints, const SolverBodies& bodies);
void solve(std::span<PrismaticConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const PrismaticConstraint& joint);

/// Distance of B's anchor from the axis now, metres.
Real axisGap(const PrismaticConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
