#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// As many welds without springs as there are lanes; see `WeldConstraint`.
struct WideWeld : WideJoint {
    LaneArray baseAngle;
    // As the bodies stand: changes only when they move.
    LaneArray armAX;
    LaneArray armAY;
    LaneArray armBX;
    LaneArray armBY;
    LaneArray gapX;
    LaneArray gapY;
    LaneArray matrixXX;
    LaneArray matrixXY;
    LaneArray matrixYY;
    LaneArray determinant;
    LaneArray spinMass;  ///< of the angle while the point is held
    LaneArray answerX;   ///< of the point to a twist
    LaneArray answerY;
    // Accumulated.
    LaneArray impulseX;
    LaneArray impulseY;
    LaneArray angularImpulse;
    LaneArray totalX;
    LaneArray totalY;
    LaneArray totalTwist;
};

using WeldKernels = JointKernels<WideWeld>;

/// Null where there are none, see `contactKernels`.
const WeldKernels* weldKernels();

}  // namespace swept::inline SWEPT_PRECISION
