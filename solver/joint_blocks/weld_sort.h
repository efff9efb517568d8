#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "../graph/block_layout.h"
#include "../solver_batch.h"
#include "../wide/wide_welds.h"

namespace swept::inline SWEPT_PRECISION {

/// Welds, for `JointBlocks`: those that a direct solve holds stand alone.
struct WeldSort {
    using Constraint = WeldConstraint;
    using Block = WideWeld;
    using Kernels = WeldKernels;

    static std::vector<WeldConstraint>& constraintsOf(SolverBatch& batch) { return batch.welds; }
    static const std::vector<WeldConstraint>& constraintsOf(const SolverBatch& batch) { return batch.welds; }
    static const WeldKernels* kernels() { return weldKernels(); }

    static BlockLayout::Kind kindOf(const WeldConstraint& joint, std::span<const BodyInertia> inertias) {
        const bool turns = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia > 0;
        if (!turns || joint.isHeld) { return BlockLayout::kAlone; }
        return static_cast<BlockLayout::Kind>((joint.hasLinearSpring ? 1U : 0U) + (joint.hasAngularSpring ? 2U : 0U) +
                                              (joint.isLinked ? 4U : 0U));
    }
    static void empty(WideWeld& block, BlockLayout::Kind kind) {
        block.parts = {(kind & 1U) != 0, (kind & 2U) != 0, (kind & 4U) != 0};
        block.totalX = block.totalY = block.totalTwist = {};
    }
    static void fill(WideWeld& block, std::size_t lane, const WeldConstraint& joint) {
        block.baseAngle[lane] = joint.baseAngle;
        block.impulseX[lane] = joint.linearImpulse.x;
        block.impulseY[lane] = joint.linearImpulse.y;
        block.angularImpulse[lane] = joint.angularImpulse;
        if (joint.hasLinearSpring) { fill(block, lane, joint.linearSpring); }
        if (!joint.hasAngularSpring) { return; }
        block.anglePush[lane] = joint.angularSpring.push;
        block.angleDrag[lane] = joint.angularSpring.drag;
        block.angleLag[lane] = joint.angularSpring.lag;
    }
    static void take(const WideWeld& block, std::size_t lane, WeldConstraint& joint) {
        joint.linearImpulse = {block.impulseX[lane], block.impulseY[lane]};
        joint.angularImpulse = block.angularImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
    }

private:
    static void fill(WideWeld& block, std::size_t lane, const PointSpring& spring) {
        block.stiffnessXX[lane] = spring.stiffness.xx;
        block.stiffnessXY[lane] = spring.stiffness.xy;
        block.stiffnessYY[lane] = spring.stiffness.yy;
        block.stiffnessDeterminant[lane] = spring.stiffness.determinant;
        block.springLoss[lane] = spring.damping.loss;
        block.springRate[lane] = spring.damping.rate;
    }
};

}  // namespace swept::inline SWEPT_PRECISION
