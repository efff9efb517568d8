#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "block_layout.h"
#include "solver_batch.h"
#include "wide_slides.h"

namespace swept::inline SWEPT_PRECISION {

/// Sliders, for `JointBlocks`.
struct SlideSort {
    using Constraint = PrismaticConstraint;
    using Block = WideSlide;
    using Kernels = SlideKernels;

    static std::vector<PrismaticConstraint>& constraintsOf(SolverBatch& batch) { return batch.prismatics; }
    static const std::vector<PrismaticConstraint>& constraintsOf(const SolverBatch& batch) { return batch.prismatics; }
    static const SlideKernels* kernels() { return slideKernels(); }

    static BlockLayout::Kind kindOf(const PrismaticConstraint& joint, std::span<const BodyInertia> inertias) {
        const bool turns = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia > 0;
        if (joint.isHeld || !turns) { return BlockLayout::kAlone; }
        return static_cast<BlockLayout::Kind>((joint.hasMotor ? 4U : 0U) + (joint.hasSpring ? 2U : 0U) +
                                              (joint.hasLimits ? 1U : 0U));
    }
    static void empty(WideSlide& block, BlockLayout::Kind kind) {
        block.parts = {(kind & 4U) != 0, (kind & 2U) != 0, (kind & 1U) != 0};
        block.totalX = block.totalY = block.totalTwist = {};
    }
    static void fill(WideSlide& block, std::size_t lane, const PrismaticConstraint& joint) {
        block.axisX[lane] = joint.axis.x;
        block.axisY[lane] = joint.axis.y;
        block.baseAngle[lane] = joint.baseAngle;
        block.lower[lane] = joint.lower;
        block.upper[lane] = joint.upper;
        block.motorSpeed[lane] = joint.motorSpeed;
        block.maxMotorImpulse[lane] = joint.maxMotorImpulse;
        block.springPush[lane] = joint.spring.push;
        block.springDrag[lane] = joint.spring.drag;
        block.heldImpulse[lane] = joint.heldImpulse.x;
        block.heldTwist[lane] = joint.heldImpulse.y;
        block.motorImpulse[lane] = joint.motorImpulse;
        block.springImpulse[lane] = joint.springImpulse;
        block.lowerImpulse[lane] = joint.lowerImpulse;
        block.upperImpulse[lane] = joint.upperImpulse;
    }
    static void take(const WideSlide& block, std::size_t lane, PrismaticConstraint& joint) {
        joint.axisNow = {block.axisNowX[lane], block.axisNowY[lane]};
        joint.heldImpulse = {block.heldImpulse[lane], block.heldTwist[lane]};
        joint.motorImpulse = block.motorImpulse[lane];
        joint.springImpulse = block.springImpulse[lane];
        joint.lowerImpulse = block.lowerImpulse[lane];
        joint.upperImpulse = block.upperImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
    }
};

}  // namespace swept::inline SWEPT_PRECISION
