#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "block_layout.h"
#include "solver_batch.h"
#include "wide_wheels.h"

namespace swept::inline SWEPT_PRECISION {

/// Wheels, for `JointBlocks`.
struct WheelSort {
    using Constraint = WheelConstraint;
    using Block = WideWheel;
    using Kernels = WheelKernels;

    static std::vector<WheelConstraint>& constraintsOf(SolverBatch& batch) { return batch.wheels; }
    static const std::vector<WheelConstraint>& constraintsOf(const SolverBatch& batch) { return batch.wheels; }
    static const WheelKernels* kernels() { return wheelKernels(); }

    static BlockLayout::Kind kindOf(const WheelConstraint& joint, std::span<const BodyInertia> inertias) {
        const bool turns = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia > 0;
        if (joint.isHeld || !turns) { return BlockLayout::kAlone; }
        return static_cast<BlockLayout::Kind>((joint.hasMotor ? 4U : 0U) + (joint.suspension.hasSpring ? 2U : 0U) +
                                              (joint.suspension.hasLimits ? 1U : 0U));
    }
    static void empty(WideWheel& block, BlockLayout::Kind kind) {
        block.parts = {(kind & 4U) != 0, (kind & 2U) != 0, (kind & 1U) != 0};
        block.totalX = block.totalY = block.totalTwist = {};
    }
    static void fill(WideWheel& block, std::size_t lane, const WheelConstraint& joint) {
        block.axisX[lane] = joint.axis.x;
        block.axisY[lane] = joint.axis.y;
        block.lower[lane] = joint.suspension.lower;
        block.upper[lane] = joint.suspension.upper;
        block.motorSpeed[lane] = joint.motorSpeed;
        block.maxMotorImpulse[lane] = joint.maxMotorImpulse;
        block.springPush[lane] = joint.suspension.spring.push;
        block.springDrag[lane] = joint.suspension.spring.drag;
        block.heldImpulse[lane] = joint.heldImpulse.x;
        block.motorImpulse[lane] = joint.motorImpulse;
        block.springImpulse[lane] = joint.suspension.springImpulse;
        block.lowerImpulse[lane] = joint.suspension.lowerImpulse;
        block.upperImpulse[lane] = joint.suspension.upperImpulse;
    }
    static void take(const WideWheel& block, std::size_t lane, WheelConstraint& joint) {
        joint.axisNow = {block.axisNowX[lane], block.axisNowY[lane]};
        joint.heldImpulse.x = block.heldImpulse[lane];
        joint.motorImpulse = block.motorImpulse[lane];
        joint.suspension.springImpulse = block.springImpulse[lane];
        joint.suspension.lowerImpulse = block.lowerImpulse[lane];
        joint.suspension.upperImpulse = block.upperImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
    }
};

}  // namespace swept::inline SWEPT_PRECISION
