#pragma once

#include <cmath>

#include "../solver/solver_batch.h"
#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// The force of a joint turns a body on by its arm: where it pulls outwards it is a spring of the angle, of r·F N·m per
/// radian. Joints that cannot all be closed, as of what hangs between two things that part, pull so hard that this
/// spring oscillates faster than sub-steps can sample; impulses that begin the next one with what the last one needed
/// then grow without end. (A box on two welds, pulled by 1 m: beyond all numbers within a third of a second.) Bodies
/// that would turn by more than a radian in a sub-step that way are iterated with so much more inertia that it is one,
/// which is what an implicit solve would see of it (Tournier et al. 2015, "Stable Constrained Dynamics"; Andrews et al.
/// 2017, "Geometric Stiffness for Real-time Constrained Multibody Dynamics").

/// Square of the radians in a sub-step by which the force of one joint lets a body oscillate.
inline Real phaseSquare(Vec2 arm, Vec2 force, Real inverseInertia, Real h) {
    return std::fabs(dot(arm, force)) * inverseInertia * (h * h);
}
/// Below that in all joints no body is looked at.
inline bool isTaut(Vec2 arm, Vec2 force, Real inverseInertia, Real h) {
    constexpr Real kTaut = Real(1) / 4;
    return phaseSquare(arm, force, inverseInertia, h) > kTaut;
}

inline bool isTaut(const JointConstraint& joint, Vec2 force, std::span<const BodyInertia> inertias, Real h) {
    return isTaut(joint.anchorA, force, inertias[joint.slotA].inverseInertia, h) ||
           isTaut(joint.anchorB, force, inertias[joint.slotB].inverseInertia, h);
}

/// After a solve by iteration, of the joints of the batch that are in no store: whether any is.
/// @param length  that was solved, s
bool anyTaut(SolverBatch& batch, Real h, Real length);

/// Before a solve by iteration, by the forces of the last step: gives bodies of the batch more inertia. @return any
/// @pre they have their slots, and no constraint has been prepared
bool stiffenTurns(WorldState& world, const TiedGroup& group, Real h);

}  // namespace swept::inline SWEPT_PRECISION
