#pragma once

#include "../state/joint.h"

namespace swept::inline SWEPT_PRECISION {

/// Impulses to start from become those of sub-steps that are so many times as long.
void scaleStart(Joint& joint, Real factor);

}  // namespace swept::inline SWEPT_PRECISION
