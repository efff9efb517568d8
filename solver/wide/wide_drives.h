#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What a motor joint drives, and how. All of a block have the same.
struct DriveParts {
    bool drivesLine = false;
    bool drivesAngle = false;
    bool seeksPlace = false;
    bool seeksAngle = false;
};

/// As many motor joints as there are lanes, all with the same parts, and no hinge beside any; see `MotorConstraint`.
struct WideDrive : WideJoint {
    DriveParts parts;
    alignas(kBlockBytes) LaneArray baseAngle;
    LaneArray approachRate;
    LaneArray ease;
    LaneArray maxLinearImpulse;
    LaneArray maxAngularImpulse;
    // Wanted: found anew by each pass with bias, of what seeks a pose.
    LaneArray velocityX;
    LaneArray velocityY;
    LaneArray spin;
    // As the bodies stand: changes only when they move.
    LaneArray armAX;
    LaneArray armAY;
    LaneArray armBX;
    LaneArray armBY;
    LaneArray offsetNowX;  ///< of B's anchor from A's
    LaneArray offsetNowY;
    LaneArray matrixXX;
    LaneArray matrixXY;
    LaneArray matrixYY;
    LaneArray determinant;
    // Accumulated.
    LaneArray impulseX;
    LaneArray impulseY;
    LaneArray angularImpulse;
    LaneArray totalX;
    LaneArray totalY;
    LaneArray totalTwist;
};

using DriveKernels = JointKernels<WideDrive>;

/// Null where there are none, see `contactKernels`; nor are there any without doubles side by side.
const DriveKernels* driveKernels();

}  // namespace swept::inline SWEPT_PRECISION
