#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_line.h"

namespace swept::inline SWEPT_PRECISION {

/// As many sliders as there are lanes, all with the same parts; see `PrismaticConstraint`.
struct WideSlide : WideLine {
    LaneArray baseAngle;
    // As the bodies stand: changes only when they move.
    LaneArray leverAcross;  ///< of the point where rows act, from B's anchor: torque of a push along the axis
    LaneArray leverAlong;   ///< of one across it
    LaneArray angle;
    LaneArray angleShare;
    // Accumulated.
    LaneArray heldTwist;
};

using SlideKernels = JointKernels<WideSlide>;

/// Null where there are none, see `contactKernels`.
const SlideKernels* slideKernels();

}  // namespace swept::inline SWEPT_PRECISION
