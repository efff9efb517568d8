#pragma once

#include "joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What a wheel has. All of a block have the same.
struct WheelParts {
    bool hasMotor = false;
    bool hasSpring = false;
    bool hasLimits = false;

    bool isSprung() const { return hasSpring || hasLimits; }
};

/// As many wheels as there are lanes, all with the same parts; see `WheelConstraint`.
struct WideWheel : WideJoint {
    WheelParts parts;
    alignas(kBlockBytes) LaneArray axisX;  ///< at the start of the step
    LaneArray axisY;
    LaneArray lower;
    LaneArray upper;
    LaneArray motorSpeed;
    LaneArray maxMotorImpulse;
    LaneArray springPush;
    LaneArray springDrag;
    // As the bodies stand: changes only when they move.
    LaneArray axisNowX;
    LaneArray axisNowY;
    LaneArray alongA;
    LaneArray alongB;
    LaneArray acrossA;
    LaneArray acrossB;
    LaneArray place;
    LaneArray gap;
    LaneArray response;
    LaneArray own;
    LaneArray coupled;
    LaneArray spinCoupled;
    LaneArray inverseMass;
    LaneArray spinInverse;
    LaneArray lonely;
    // Accumulated.
    LaneArray heldImpulse;
    LaneArray motorImpulse;
    LaneArray springImpulse;
    LaneArray lowerImpulse;
    LaneArray upperImpulse;
    LaneArray totalX;
    LaneArray totalY;
    LaneArray totalTwist;
};

using WheelKernels = JointKernels<WideWheel>;

/// Null where there are none, see `contactKernels`.
const WheelKernels* wheelKernels();

}  // namespace swept::inline SWEPT_PRECISION
