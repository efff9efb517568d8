#pragma once

#include <array>
#include <cstdint>

#include "joint_kernels.h"
#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// What the solve of a hinge has beside its point. All joints of a block have the same.
struct HingeParts {
    bool hasSpring = false;
    bool hasMotor = false;
    bool hasLimits = false;

    bool any() const { return hasSpring || hasMotor || hasLimits; }
    bool operator==(const HingeParts&) const = default;
};

/// As many hinges as there are lanes, no movable body in two of them; see `RevoluteConstraint`. Lanes that are left
/// over hold the fixed world to itself.
struct alignas(kBlockBytes) WideRevolute {
    std::array<BodySlot, kBlockLanes> slotA;
    std::array<BodySlot, kBlockLanes> slotB;
    std::uint32_t lanes = 0;                       ///< in use
    std::uint32_t movableA = 0;                    ///< one bit per lane: the body is to be written
    std::uint32_t movableB = 0;
    HingeParts parts;
    alignas(kBlockBytes) LaneArray anchorAX;
    LaneArray anchorAY;
    LaneArray anchorBX;
    LaneArray anchorBY;
    LaneArray offsetX;  ///< between the centres at the start of the step
    LaneArray offsetY;
    LaneArray baseAngle;
    LaneArray biasRate;
    LaneArray massScale;
    LaneArray impulseScale;
    LaneArray inverseMassA;
    LaneArray inverseMassB;
    LaneArray inverseInertiaA;
    LaneArray inverseInertiaB;
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
    LaneArray lowerImpulse;
    LaneArray upperImpulse;
    LaneArray motorImpulse;
    LaneArray springImpulse;
};

using RevoluteKernels = JointKernels<WideRevolute>;

/// Null where there are none, see `contactKernels`.
const RevoluteKernels* revoluteKernels();

}  // namespace swept::inline SWEPT_PRECISION
