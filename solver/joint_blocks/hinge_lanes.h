#pragma once

#include "../joints/revolute_constraint.h"
#include "../wide/wide_revolutes.h"
#include "joint_lanes.h"

/// How a hinge is laid into a lane of a block, and read from there.

namespace swept::inline SWEPT_PRECISION {

/// A hinge without its parts.
struct HingeHead {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Vec2 anchorA{};
    Vec2 anchorB{};
    Vec2 centerOffset{};
    Softness softness{};
    Vec2 impulse{};  ///< of the sub-step before
};

/// Lanes of one block may be filled at the same time. @pre the block was emptied
inline void fillHead(WideRevolute& block, std::size_t lane, const HingeHead& head, const BodyInertia& a,
                     const BodyInertia& b) {
    fillJoint(block, lane, head, a, b);
    block.impulseX[lane] = head.impulse.x;
    block.impulseY[lane] = head.impulse.y;
}

/// Of a block with parts. @param baseAngle  of the joint at the start of the step
inline void fillParts(WideRevolute& block, std::size_t lane, const FreedomParts& parts, Real baseAngle) {
    block.baseAngle[lane] = baseAngle;
    block.lower[lane] = parts.lower;
    block.upper[lane] = parts.upper;
    block.motorSpeed[lane] = parts.motorSpeed;
    block.maxMotorImpulse[lane] = parts.maxMotorImpulse;
    block.springPush[lane] = parts.spring.push;
    block.springDrag[lane] = parts.spring.drag;
    block.springLag[lane] = parts.spring.lag;
    block.lowerImpulse[lane] = parts.lowerImpulse;
    block.upperImpulse[lane] = parts.upperImpulse;
    block.motorImpulse[lane] = parts.motorImpulse;
    block.springImpulse[lane] = parts.springImpulse;
}

/// Over the step.
inline JointReaction totalOf(const WideRevolute& block, std::size_t lane) {
    return {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
}

/// Impulses of the last sub-step, and totals.
inline void takeLane(const WideRevolute& block, std::size_t lane, RevoluteConstraint& joint) {
    joint.linearImpulse = {block.impulseX[lane], block.impulseY[lane]};
    joint.total = totalOf(block, lane);
    if (!block.parts.any()) {
        joint.lowerImpulse = joint.upperImpulse = joint.motorImpulse = joint.springImpulse = 0;
        return;
    }
    joint.lowerImpulse = block.lowerImpulse[lane];
    joint.upperImpulse = block.upperImpulse[lane];
    joint.motorImpulse = block.motorImpulse[lane];
    joint.springImpulse = block.springImpulse[lane];
}

}  // namespace swept::inline SWEPT_PRECISION
