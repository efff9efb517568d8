#pragma once

#include <vector>

#include "../solver_batch.h"
#include "joint_islands.h"

namespace swept::inline SWEPT_PRECISION {

/// What `JointIslands` left of a batch, as a batch of its own.
class UndoneIslands {
public:
    /// @pre islands left some of it in their last solve
    SolverBatch& take(const SolverBatch& from, const JointIslands& islands);
    /// Puts back what a solve made of it.
    void giveBack(SolverBatch& to) const;

private:
    BodySlot slotOf(const SolverBatch& from, BodySlot slot);

    SolverBatch batch_;            ///< sources of joints are their places in the other
    std::vector<BodySlot> slots_;  ///< in the batch that it was taken from
    std::vector<BodySlot> own_;    ///< by slot of that
};

}  // namespace swept::inline SWEPT_PRECISION
