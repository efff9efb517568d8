#pragma once

#include "joint_kernels.h"
#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What a slider has along its axis. All of a block have the same.
struct SlideParts {
    bool hasMotor = false;
    bool hasSpring = false;
    bool hasLimits = false;

    bool any() const { return hasMotor || hasSpring || hasLimits; }
};

/// As many sliders as there are lanes, all with the same parts; see `PrismaticConstraint`.
struct WideSlide : WideJoint {
    SlideParts parts;
    alignas(kBlockBytes) LaneArray axisX;  ///< at the start of the step
    LaneArray axisY;
    LaneArray baseAngle;
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
    LaneArray inverseMass;
    LaneArray lonely;
    LaneArray leverAcross;  ///< of the point where rows act, from B's anchor: torque of a push along the axis
    LaneArray leverAlong;   ///< of one across it
    LaneArray angle;
    LaneArray angleShare;
    // Accumulated.
    LaneArray heldImpulse;
    LaneArray heldTwist;
    LaneArray motorImpulse;
    LaneArray springImpulse;
    LaneArray lowerImpulse;
    LaneArray upperImpulse;
    LaneArray totalX;
    LaneArray totalY;
    LaneArray totalTwist;
};

using SlideKernels = JointKernels<WideSlide>;

/// Null where there are none, see `contactKernels`.
const SlideKernels* slideKernels();

}  // namespace swept::inline SWEPT_PRECISION
