#pragma once

#include "wide_joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What a slider or a wheel has beside its line. All of a block have the same.
struct LineParts {
    bool hasMotor = false;
    bool hasSpring = false;
    bool hasLimits = false;

    bool isSprung() const { return hasSpring || hasLimits; }
    bool any() const { return hasMotor || isSprung(); }
};

/// What blocks of joints have along whose axis B slides; see guided_line.h and freedom_parts.h.
struct WideLine : WideJoint {
    LineParts parts;
    alignas(kBlockBytes) LaneArray axisX;  ///< at the start of the step
    LaneArray axisY;
    LaneArray lower;
    LaneArray upper;
    LaneArray motorSpeed;
    LaneArray maxMotorImpulse;
    LaneArray springPush;
    LaneArray springDrag;
    LaneArray springLag;
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

}  // namespace swept::inline SWEPT_PRECISION
