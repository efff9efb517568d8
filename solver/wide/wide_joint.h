#pragma once

#include <array>
#include <cstdint>

#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// What blocks of all sorts of joints have: as many joints as there are lanes, no movable body in two of them. Lanes
/// that are left over hold the fixed world to itself. What a joint is made of stays all step; see `JointConstraint`.
struct alignas(kBlockBytes) WideJoint {
    std::array<StateOffset, kBlockLanes> stateA;
    std::array<StateOffset, kBlockLanes> stateB;
    std::uint32_t lanes = 0;     ///< in use
    std::uint32_t movableA = 0;  ///< one bit per lane: the body is to be written
    std::uint32_t movableB = 0;
    alignas(kBlockBytes) LaneArray anchorAX;
    LaneArray anchorAY;
    LaneArray anchorBX;
    LaneArray anchorBY;
    LaneArray offsetX;  ///< between the centres at the start of the step
    LaneArray offsetY;
    LaneArray biasRate;
    LaneArray massScale;
    LaneArray impulseScale;
    LaneArray inverseMassA;
    LaneArray inverseMassB;
    LaneArray inverseInertiaA;
    LaneArray inverseInertiaB;
};

}  // namespace swept::inline SWEPT_PRECISION
