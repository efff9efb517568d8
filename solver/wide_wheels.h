#pragma once

#include <array>
#include <cstdint>

#include "joint_kernels.h"
#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// What a wheel has. All of a block have the same.
struct WheelParts {
    bool hasMotor = false;
    bool hasSpring = false;
    bool hasLimits = false;

    bool isSprung() const { return hasSpring || hasLimits; }
};

/// As many wheels as there are lanes, no movable body in two of them; see `WheelConstraint`. Lanes that are left over hold
/// the fixed world to itself.
struct alignas(kBlockBytes) WideWheel {
    std::array<BodySlot, kBlockLanes> slotA;
    std::array<BodySlot, kBlockLanes> slotB;
    std::uint32_t lanes = 0;     ///< in use
    std::uint32_t movableA = 0;  ///< one bit per lane: the body is to be written
    std::uint32_t movableB = 0;
    WheelParts parts;
    alignas(kBlockBytes) LaneArray anchorAX;
    LaneArray anchorAY;
    LaneArray anchorBX;
    LaneArray anchorBY;
    LaneArray offsetX;  ///< between the centres at the start of the step
    LaneArray offsetY;
    LaneArray axisX;  ///< at the start of the step
    LaneArray axisY;
    LaneArray lower;
    LaneArray upper;
    LaneArray motorSpeed;
    LaneArray maxMotorImpulse;
    LaneArray springPush;
    LaneArray springDrag;
    LaneArray biasRate;
    LaneArray massScale;
    LaneArray impulseScale;
    LaneArray inverseMassA;
    LaneArray inverseMassB;
    LaneArray inverseInertiaA;
    LaneArray inverseInertiaB;
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
