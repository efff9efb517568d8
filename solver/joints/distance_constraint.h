#pragma once

#include "joint_constraint.h"
#include "limit_pace.h"

namespace swept::inline SWEPT_PRECISION {

/// The distance of two anchors is held (rod), kept within limits (rope), or pulled to a length (spring).
struct DistanceConstraint : JointConstraint {
    Real length = 0;  ///< of rod or spring, metres; as the limits of `FreedomParts`
    Real minLength = 0;
    Real maxLength = 0;
    LimitMotion motion;  ///< of a rod the lower one is that of its length
    TurningSpring spring;
    bool isRigid = true;
    bool hasSpring = false;
    bool hasLimits = false;
    bool isGliding = false;  ///< length and limits move
    Vec2 axis{1, 0};         ///< unit, from A's anchor to B's, renewed each sub-step; kept when the anchors coincide
    /// Accumulated; warm start in, result out. N·s per sub-step.
    Real rigidImpulse = 0;
    Real springImpulse = 0;
    Real lowerImpulse = 0;
    Real upperImpulse = 0;

    constexpr Real impulse() const { return rigidImpulse + springImpulse + lowerImpulse - upperImpulse; }
};

/// The effective mass turns with the axis: it is taken anew in each sub-step.
void prepare(DistanceConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<DistanceConstraint> joints, const SolverBodies& bodies);
void solve(std::span<DistanceConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const DistanceConstraint& joint);

/// By how much rod or limits are violated now, metres, at least 0. A spring has no error.
Real lengthError(const DistanceConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
