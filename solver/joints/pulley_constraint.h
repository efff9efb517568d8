#pragma once

#include "freedom_parts.h"
#include "joint_constraint.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// A rope from A's anchor up to a fixed wheel, over to another one, and down to B's anchor: lengthA + ratio·lengthB is
/// at most `totalLength`. The rope pulls and never pushes.
struct PulleyConstraint : JointConstraint {
    Vec2 offsetA;  ///< centre of A minus its wheel at the start of the step, metres
    Vec2 offsetB;
    Real ratio = 1;        ///< greater than 0
    Real totalLength = 0;  ///< metres
    Vec2 axisA{0, -1};     ///< unit, from the wheel to the anchor, renewed each sub-step; kept when they coincide
    Vec2 axisB{0, -1};
    Real tension = 0;  ///< on A's side; accumulated; warm start in, result out. N·s per sub-step
};

void prepare(PulleyConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<PulleyConstraint> joints, const SolverBodies& bodies);
void solve(std::span<PulleyConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const PulleyConstraint& joint);

/// lengthA + ratio·lengthB now, metres.
Real ropeLength(const PulleyConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
