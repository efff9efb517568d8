#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_line.h"

namespace swept::inline SWEPT_PRECISION {

/// As many wheels as there are lanes, all with the same parts; see `WheelConstraint`.
struct WideWheel : WideLine {
    alignas(kBlockBytes) LaneArray springStiffness;
    LaneArray springLoss;
    LaneArray springRate;
    // As the bodies stand: changes only when they move.
    LaneArray spinCoupled;
    LaneArray spinInverse;
};

using WheelKernels = JointKernels<WideWheel>;

/// Null where there are none, see `contactKernels`.
const WheelKernels* wheelKernels();

}  // namespace swept::inline SWEPT_PRECISION
