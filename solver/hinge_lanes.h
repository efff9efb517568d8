#pragma once

#include "revolute_constraint.h"
#include "wide_revolutes.h"

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
    block.slotA[lane] = head.slotA;
    block.slotB[lane] = head.slotB;
    block.anchorAX[lane] = head.anchorA.x;
    block.anchorAY[lane] = head.anchorA.y;
    block.anchorBX[lane] = head.anchorB.x;
    block.anchorBY[lane] = head.anchorB.y;
    block.offsetX[lane] = head.centerOffset.x;
    block.offsetY[lane] = head.centerOffset.y;
    block.biasRate[lane] = head.softness.biasRate;
    block.massScale[lane] = head.softness.massScale;
    block.impulseScale[lane] = head.softness.impulseScale;
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
    block.impulseX[lane] = head.impulse.x;
    block.impulseY[lane] = head.impulse.y;
}

/// Ends what the heads of the lanes began.
inline void closeBlock(WideRevolute& block) {
    block.movableA = block.movableB = 0;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        const BodyInertia a{.inverseMass = block.inverseMassA[lane], .inverseInertia = block.inverseInertiaA[lane]};
        const BodyInertia b{.inverseMass = block.inverseMassB[lane], .inverseInertia = block.inverseInertiaB[lane]};
        block.movableA |= (isMovable(a) ? 1U : 0U) << lane;
        block.movableB |= (isMovable(b) ? 1U : 0U) << lane;
    }
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
    block.lowerImpulse[lane] = parts.lowerImpulse;
    block.upperImpulse[lane] = parts.upperImpulse;
    block.motorImpulse[lane] = parts.motorImpulse;
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
