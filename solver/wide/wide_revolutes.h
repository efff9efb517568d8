#pragma once

#include "../joint_blocks/joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What the solve of a hinge has beside its point. All joints of a block have the same.
struct HingeParts {
    bool hasSpring : 1 = false;
    bool hasMotor : 1 = false;
    bool hasLimits : 1 = false;
    bool isGliding : 1 = false;  ///< these move: then it stands in no block

    bool any() const { return hasSpring || hasMotor || hasLimits; }
    bool operator==(const HingeParts&) const = default;
};

/// As many hinges as there are lanes, all with the same parts; see `RevoluteConstraint`.
struct WideRevolute : WideJoint {
    HingeParts parts;
    alignas(kBlockBytes) LaneArray baseAngle;
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
    // Accumulated.
    LaneArray impulseX;
    LaneArray impulseY;
    LaneArray totalX;
    LaneArray totalY;
    LaneArray totalTwist;
    // Of parts; of a block without any, nothing sets them.
    LaneArray lower;
    LaneArray upper;
    LaneArray motorSpeed;
    LaneArray maxMotorImpulse;
    LaneArray springPush;
    LaneArray springDrag;
    LaneArray springLag;
    LaneArray lowerImpulse;
    LaneArray upperImpulse;
    LaneArray motorImpulse;
    LaneArray springImpulse;
};

using RevoluteKernels = JointKernels<WideRevolute>;

/// Null where there are none, see `contactKernels`.
const RevoluteKernels* revoluteKernels();

}  // namespace swept::inline SWEPT_PRECISION
