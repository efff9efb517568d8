#pragma once

#include "guided_row.h"
#include "joint_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// The spring of a point: of fixed stiffness along axes that turn with A, so that its energy is a function of where B's
/// point is in the frame of A, and what turns gains nothing from it.
struct PointSpring {
    PointMatrix stiffness;  ///< as `TurningSpring::stiffness`; as A stands at the start of the step
    TurningSpring damping;  ///< of all directions alike; without stiffness of its own
};

/// Two bodies share a point and an angle, each rigidly or by a spring. All three rows rigid are solved as one block;
/// where one of the two parts is a spring, it has the inertia that it moves while the other part holds.
struct WeldConstraint : JointConstraint {
    Real baseAngle = 0;        ///< angle of B relative to A at the start of the step, rad; held at 0
    PointSpring linearSpring;  ///< what it does to A, it does where B's point is
    SpringGains angularSpring;
    bool hasLinearSpring = false;  ///< false: rigid
    /// The body that turns most easily, about its lever, is held by other joints, too.
    bool isLinked = false;
    bool hasAngularSpring = false;
    /// Accumulated; warm start in, result out. Per sub-step.
    Vec2 linearImpulse;       ///< N·s
    Real angularImpulse = 0;  ///< N·m·s
};

void prepare(WeldConstraint& joint, std::span<const BodyInertia> inertias);
void warmStart(std::span<WeldConstraint> joints, const SolverBodies& bodies);
void solve(std::span<WeldConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);
JointReaction reactionOf(const WeldConstraint& joint);

}  // namespace swept::inline SWEPT_PRECISION
