#pragma once

#include <array>
#include <cstdint>

#include "joint_kernels.h"
#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// What a distance joint has. All of a block have the same.
struct RodParts {
    bool isRigid = false;
    bool hasSpring = false;
    bool hasLimits = false;
};

/// As many distance joints as there are lanes, no movable body in two of them; see `DistanceConstraint`. Lanes that are
/// left over hold the fixed world to itself.
struct alignas(kBlockBytes) WideRod {
    std::array<BodySlot, kBlockLanes> slotA;
    std::array<BodySlot, kBlockLanes> slotB;
    std::uint32_t lanes = 0;     ///< in use
    std::uint32_t movableA = 0;  ///< one bit per lane: the body is to be written
    std::uint32_t movableB = 0;
    RodParts parts;
    alignas(kBlockBytes) LaneArray anchorAX;
    LaneArray anchorAY;
    LaneArray anchorBX;
    LaneArray anchorBY;
    LaneArray offsetX;  ///< between the centres at the start of the step
    LaneArray offsetY;
    LaneArray length;  ///< of rod or spring
    LaneArray minLength;
    LaneArray maxLength;
    LaneArray biasRate;
    LaneArray massScale;
    LaneArray impulseScale;
    LaneArray springPush;
    LaneArray springDrag;
    LaneArray inverseMassA;
    LaneArray inverseMassB;
    LaneArray inverseInertiaA;
    LaneArray inverseInertiaB;
    // As the bodies stand: changes only when they move.
    LaneArray armAX;
    LaneArray armAY;
    LaneArray armBX;
    LaneArray armBY;
    LaneArray axisX;
    LaneArray axisY;
    LaneArray lengthNow;
    LaneArray mass;  ///< 0 where nothing can be moved
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
