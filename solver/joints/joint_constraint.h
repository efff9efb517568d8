#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "../body_state.h"
#include "../softness.h"

namespace swept::inline SWEPT_PRECISION {

/// What a joint does to body B: force times time and torque times time, N·s and N·m·s. The force acts at B's anchor;
/// body A takes the opposite at the same place.
struct JointReaction {
    Vec2 impulse;
    Real twist = 0;
};

/// Common to the constraints of all joints. Anchors are relative to the centres of mass, world orientation, at the
/// start of the step.
///
/// Every kind offers the same functions: `prepare(joint, inertias)` before the first sub-step (drops warm-start
/// impulses of limits, motors and springs that it no longer has, computes what stays the same in all sub-steps),
/// `warmStart(joints, bodies)`, `solve(joints, bodies, h, useBias)` (`useBias` false: relaxation, only velocities),
/// `reactionOf(joint)` (of the last sub-step), and `bodySlots(joint)`, the bodies that it moves. The span of one call
/// shares no body, or is solved in order.
struct JointConstraint {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Vec2 anchorA;
    Vec2 anchorB;
    Vec2 centerOffset;  ///< centre of B minus centre of A at the start of the step, metres
    Softness softness;  ///< of what is rigid: anchors, lengths, limits
    bool isHeld =
        false;  ///< a direct solve brings anchors, lengths and angles to where they belong: no bias moves them
    bool isDriveHeld = false;  ///< its motor is a row of that solve, too: only relaxation moves it
    Real woundSpeed = 0;       ///< m/s at which what it holds is given another length or place: it does work
    std::uint32_t source = 0;  ///< the engine's name for the joint
    JointReaction total;       ///< over the step: the sum of the sub-steps
};

inline std::array<BodySlot, 2> bodySlots(const JointConstraint& joint) { return {joint.slotA, joint.slotB}; }

/// How the rows of a joint are solved: in each sub-step with bias, which closes errors, and then without, which takes
/// away the speed that this gave.
struct JointPass {
    const Softness& softness;
    Real h = 0;  ///< of a sub-step, s
    bool useBias = false;
    bool drives = true;  ///< nothing else holds its motor
};
inline JointPass passOf(const JointConstraint& joint, Real h, bool useBias) {
    return {joint.softness, h, useBias, !joint.isDriveHeld || !useBias};
}

/// Anchor of B minus anchor of A now, metres.
inline Vec2 anchorOffset(const JointConstraint& joint, const BodyState& a, const BodyState& b) {
    return joint.centerOffset + (b.deltaPosition - a.deltaPosition) + rotate(b.deltaRotation, joint.anchorB) -
           rotate(a.deltaRotation, joint.anchorA);
}

/// Ends a sub-step.
template <class Joint>
void addUpReactions(std::span<Joint> joints) {
    for (Joint& joint : joints) {
        const JointReaction reaction = reactionOf(joint);
        joint.total.impulse += reaction.impulse;
        joint.total.twist += reaction.twist;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
