#pragma once

#include <cstddef>
#include <vector>

#include "../graph/block_layout.h"
#include "../solver_batch.h"
#include "../wide/wide_rods.h"

namespace swept::inline SWEPT_PRECISION {

/// Distance joints, for `JointBlocks`.
struct RodSort {
    using Constraint = DistanceConstraint;
    using Block = WideRod;
    using Kernels = RodKernels;

    static std::vector<DistanceConstraint>& constraintsOf(SolverBatch& batch) { return batch.distances; }
    static const std::vector<DistanceConstraint>& constraintsOf(const SolverBatch& batch) { return batch.distances; }
    static const RodKernels* kernels() { return rodKernels(); }

    static BlockLayout::Kind kindOf(const DistanceConstraint& joint, std::span<const BodyInertia>) {
        if (joint.isHeld || joint.isGliding) { return BlockLayout::kAlone; }
        return static_cast<BlockLayout::Kind>((joint.isRigid ? 4U : 0U) + (joint.hasSpring ? 2U : 0U) +
                                              (joint.hasLimits ? 1U : 0U));
    }
    static void empty(WideRod& block, BlockLayout::Kind kind) {
        block.parts = {(kind & 4U) != 0, (kind & 2U) != 0, (kind & 1U) != 0};
        block.totalX = block.totalY = {};
    }
    static void fill(WideRod& block, std::size_t lane, const DistanceConstraint& joint) {
        block.length[lane] = joint.length;
        block.minLength[lane] = joint.minLength;
        block.maxLength[lane] = joint.maxLength;
        block.springStiffness[lane] = joint.spring.stiffness;
        block.springLoss[lane] = joint.spring.loss;
        block.springRate[lane] = joint.spring.rate;
        block.axisX[lane] = joint.axis.x;
        block.axisY[lane] = joint.axis.y;
        block.rigidImpulse[lane] = joint.rigidImpulse;
        block.springImpulse[lane] = 0;  // made anew by each warm start, of those that have one
        block.lowerImpulse[lane] = joint.lowerImpulse;
        block.upperImpulse[lane] = joint.upperImpulse;
    }
    static void take(const WideRod& block, std::size_t lane, DistanceConstraint& joint) {
        joint.axis = {block.axisX[lane], block.axisY[lane]};
        joint.rigidImpulse = block.rigidImpulse[lane];
        joint.springImpulse = block.springImpulse[lane];
        joint.lowerImpulse = block.lowerImpulse[lane];
        joint.upperImpulse = block.upperImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, 0};
    }
};

}  // namespace swept::inline SWEPT_PRECISION
