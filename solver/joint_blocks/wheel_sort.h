#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "../solver_batch.h"
#include "../wide/wide_wheels.h"
#include "line_sort.h"

namespace swept::inline SWEPT_PRECISION {

/// Wheels, for `JointBlocks`.
struct WheelSort : LineSort {
    using Constraint = WheelConstraint;
    using Block = WideWheel;
    using Kernels = WheelKernels;

    static std::vector<WheelConstraint>& constraintsOf(SolverBatch& batch) { return batch.wheels; }
    static const std::vector<WheelConstraint>& constraintsOf(const SolverBatch& batch) { return batch.wheels; }
    static const WheelKernels* kernels() { return wheelKernels(); }

    static BlockLayout::Kind kindOf(const WheelConstraint& joint, std::span<const BodyInertia> inertias) {
        return LineSort::kindOf(joint, joint.suspension, inertias);
    }
    static void fill(WideWheel& block, std::size_t lane, const WheelConstraint& joint) {
        LineSort::fill(block, lane, joint, joint.suspension);
        block.springStiffness[lane] = joint.spring.stiffness;
        block.springLoss[lane] = joint.spring.loss;
        block.springRate[lane] = joint.spring.rate;
    }
    static void take(const WideWheel& block, std::size_t lane, WheelConstraint& joint) {
        LineSort::take(block, lane, joint, joint.suspension);
        if (!joint.suspension.hasSpring) { return; }
        joint.suspension.spring = {block.springPush[lane], block.springDrag[lane], block.springLag[lane]};
    }
};

}  // namespace swept::inline SWEPT_PRECISION
