#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "../solver_batch.h"
#include "../wide/wide_slides.h"
#include "line_sort.h"

namespace swept::inline SWEPT_PRECISION {

/// Sliders, for `JointBlocks`.
struct SlideSort : LineSort {
    using Constraint = PrismaticConstraint;
    using Block = WideSlide;
    using Kernels = SlideKernels;

    static std::vector<PrismaticConstraint>& constraintsOf(SolverBatch& batch) { return batch.prismatics; }
    static const std::vector<PrismaticConstraint>& constraintsOf(const SolverBatch& batch) { return batch.prismatics; }
    static const SlideKernels* kernels() { return slideKernels(); }

    static BlockLayout::Kind kindOf(const PrismaticConstraint& joint, std::span<const BodyInertia> inertias) {
        return LineSort::kindOf(joint, joint, inertias);
    }
    static void fill(WideSlide& block, std::size_t lane, const PrismaticConstraint& joint) {
        LineSort::fill(block, lane, joint, joint);
        block.baseAngle[lane] = joint.baseAngle;
        block.heldTwist[lane] = joint.heldImpulse.y;
    }
    static void take(const WideSlide& block, std::size_t lane, PrismaticConstraint& joint) {
        LineSort::take(block, lane, joint, joint);
        joint.heldImpulse.y = block.heldTwist[lane];
    }
};

}  // namespace swept::inline SWEPT_PRECISION
