#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What a distance joint has. All of a block have the same.
struct RodParts {
    bool isRigid = false;
    bool hasSpring = false;
    bool hasLimits = false;
};

/// As many distance joints as there are lanes, all with the same parts; see `DistanceConstraint`.
struct WideRod : WideJoint {
    RodParts parts;
    alignas(kBlockBytes) LaneArray length;  ///< of rod or spring
    LaneArray minLength;
    LaneArray maxLength;
    LaneArray springStiffness;
    LaneArray springLoss;
    LaneArray springRate;
    // As the bodies stand: changes only when they move.
    LaneArray armAX;
    LaneArray armAY;
    LaneArray armBX;
    LaneArray armBY;
    LaneArray axisX;
    LaneArray axisY;
    LaneArray lengthNow;
    LaneArray mass;  ///< 0 where nothing can be moved
    LaneArray springPush;
    LaneArray springDrag;
    LaneArray springLag;
    // Accumulated.
    LaneArray rigidImpulse;
    LaneArray springImpulse;
    LaneArray lowerImpulse;
    LaneArray upperImpulse;
    LaneArray totalX;
    LaneArray totalY;
};

using RodKernels = JointKernels<WideRod>;

/// Null where there are none, see `contactKernels`; nor are there any without doubles side by side.
const RodKernels* rodKernels();

}  // namespace swept::inline SWEPT_PRECISION
