#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

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
/// The larger one of its two bodies.
inline Real phaseSquare(const JointConstraint& joint, Vec2 force, std::span<const BodyInertia> inertias, Real h) {
    return std::max(phaseSquare(joint.anchorA, force, inertias[joint.slotA].inverseInertia, h),
                    phaseSquare(joint.anchorB, force, inertias[joint.slotB].inverseInertia, h));
}

/// After a solve: notes whether a joint is to be looked at before the next one. Inertia that it was given made its
/// square smaller. @param isTaut  so far; by joint, so that several workers may note theirs
/// @return the same
inline bool noteTaut(std::uint8_t& isTaut, Real square) {
    constexpr Real kBecomesTaut = Real(1) / 4;
    constexpr Real kStaysTaut = Real(1) / 16;
    const std::uint8_t now = square > (isTaut != 0 ? kStaysTaut : kBecomesTaut) ? 1 : 0;
    if (isTaut != now) { isTaut = now; }  // who only reads leaves the cache line to others
    return now != 0;
}

/// Likewise of the joints of the batch that are in no store. @return whether any is
/// @param length  that was solved, s
bool noteTaut(WorldState& world, SolverBatch& batch, Real h, Real length);

/// Before a solve by iteration, by the forces of the last step: gives bodies of the batch more inertia.
/// @pre they have their slots, and no constraint has been prepared
void stiffenTurns(WorldState& world, const TiedGroup& group, Real h);

}  // namespace swept::inline SWEPT_PRECISION
