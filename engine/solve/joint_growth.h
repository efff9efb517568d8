#pragma once

#include <cstdint>

#include "../state/joint.h"
#include "../state/remainder_steps.h"

/// What joints carry from one step to the next, as its length changes.

namespace swept::inline SWEPT_PRECISION {

/// Impulses to start from become those of sub-steps that are so many times as long.
void scaleStart(Joint& joint, Real factor);

/// @param index  of the joint
JointStart startOf(Joint& joint, std::uint32_t index);
/// @pre `start` is of the joint
void setStart(Joint& joint, const JointStart& start);

}  // namespace swept::inline SWEPT_PRECISION
