#pragma once

#include <span>

#include "../contacts/contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// Kernels over blocks of joints of one colour: what `warmStart` and `solve` of the constraints do, to the bit.
template <class Block>
struct JointKernels {
    /// @param hasMoved  bodies have moved since the pass before
    void (*warmStart)(std::span<Block> blocks, const SolverBodies& bodies, bool hasMoved);
    void (*solve)(std::span<Block> blocks, const SolverBodies& bodies, const ContactPass& pass);
};

}  // namespace swept::inline SWEPT_PRECISION
