#pragma once

#include <optional>

#include "../solver_batch.h"
#include "island_drive.h"

namespace swept::inline SWEPT_PRECISION {

/// How long a step is.
struct DrivenStep {
    double h = 0;         ///< s, of a sub-step
    double duration = 0;  ///< s, of all of them
};

/// What a joint does along the ways that it leaves free.
struct JointDrives {
    /// Whether that is smooth, as far as the start of the step tells: it reaches no limit, no motor gets, or leaves,
    /// its speed, and springs are slow enough to be followed.
    bool areSmooth = true;
    std::optional<IslandDrive> turn;
    std::optional<IslandDrive> slide;
};

JointDrives drivesOf(const SolverBatch& batch, const RevoluteConstraint& joint, const DrivenStep& step);
JointDrives drivesOf(const SolverBatch& batch, const PrismaticConstraint& joint, const DrivenStep& step);
JointDrives drivesOf(const SolverBatch& batch, const WheelConstraint& joint, const DrivenStep& step);
/// @pre the spring holds its angle, and nothing its point
JointDrives drivesOf(const SolverBatch& batch, const WeldConstraint& joint, const DrivenStep& step);

}  // namespace swept::inline SWEPT_PRECISION
