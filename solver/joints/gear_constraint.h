#pragma once

#include "joint_constraint.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

/// One of the two joints of a gear: the angle of its B relative to its A, or B's translation along an axis fixed in A.
struct GearSide {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    bool slides = false;  ///< false: an angle
    Vec2 axis{1, 0};      ///< of a slide: unit, world, at the start of the step
    Vec2 anchorA;         ///< of a slide, as in `JointConstraint`
    Vec2 anchorB;
    Vec2 centerOffset;
};

/// Couples the coordinates of two joints: first + ratio·second stays what it is. Up to four bodies, of which some may
/// be the same. `slotA`, `slotB` are the bodies that the joints move.
struct GearConstraint : JointConstraint {
    GearSide first;
    GearSide second;
    Real ratio = 1;      ///< metres or radians of the first per metre or radian of the second
    Real baseError = 0;  ///< first + ratio·second − constant at the start of the step
    Vec2 axisNow{1, 0};  ///< of the second side in the last sub-step
    Real impulse = 0;  ///< on the first coordinate; accumulated; warm start in, result out. N·s or N·m·s per sub-step
};

std::array<BodySlot, 4> bodySlots(const GearConstraint& gear);
void prepare(GearConstraint& gear, std::span<const BodyInertia> inertias);
void warmStart(std::span<GearConstraint> gears, const SolverBodies& bodies);
void solve(std::span<GearConstraint> gears, const SolverBodies& bodies, Real h, bool useBias);
/// On B of the second joint.
JointReaction reactionOf(const GearConstraint& gear);

}  // namespace swept::inline SWEPT_PRECISION
