#pragma once

#include <array>
#include <cstdint>

#include "joint_kernels.h"
#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// As many welds without springs as there are lanes, no movable body in two of them; see `WeldConstraint`. Lanes that are
/// left over hold the fixed world to itself.
struct alignas(kBlockBytes) WideWeld {
    std::array<BodySlot, kBlockLanes> slotA;
    std::array<BodySlot, kBlockLanes> slotB;
    std::uint32_t lanes = 0;     ///< in use
    std::uint32_t movableA = 0;  ///< one bit per lane: the body is to be written
    std::uint32_t movableB = 0;
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
