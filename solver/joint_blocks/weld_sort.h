#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "../graph/block_layout.h"
#include "../solver_batch.h"
#include "../wide/wide_welds.h"

namespace swept::inline SWEPT_PRECISION {

/// Welds, for `JointBlocks`: those with springs stand alone.
struct WeldSort {
    using Constraint = WeldConstraint;
    using Block = WideWeld;
    using Kernels = WeldKernels;

    static std::vector<WeldConstraint>& constraintsOf(SolverBatch& batch) { return batch.welds; }
    static const std::vector<WeldConstraint>& constraintsOf(const SolverBatch& batch) { return batch.welds; }
    static const WeldKernels* kernels() { return weldKernels(); }

    static BlockLayout::Kind kindOf(const WeldConstraint& joint, std::span<const BodyInertia> inertias) {
        const bool isRigid = !joint.hasLinearSpring && !joint.hasAngularSpring;
        const bool turns = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia > 0;
        return isRigid && turns && !joint.isHeld ? BlockLayout::Kind{0} : BlockLayout::kAlone;
    }
    static void empty(WideWeld& block, BlockLayout::Kind) { block.totalX = block.totalY = block.totalTwist = {}; }
    static void fill(WideWeld& block, std::size_t lane, const WeldConstraint& joint) {
        block.baseAngle[lane] = joint.baseAngle;
        block.impulseX[lane] = joint.linearImpulse.x;
        block.impulseY[lane] = joint.linearImpulse.y;
        block.angularImpulse[lane] = joint.angularImpulse;
    }
    static void take(const WideWeld& block, std::size_t lane, WeldConstraint& joint) {
        joint.linearImpulse = {block.impulseX[lane], block.impulseY[lane]};
        joint.angularImpulse = block.angularImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
    }
};

}  // namespace swept::inline SWEPT_PRECISION
