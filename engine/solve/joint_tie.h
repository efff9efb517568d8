#pragma once

#include "../state/joint.h"

namespace swept::inline SWEPT_PRECISION {

/// What kind of joint it is, as the step asks of all of them. To be asked again where a call changed its parts, its
/// limits of breaking, its rest load, or whether it holds.
JointTie tieOf(const Joint& joint);

}  // namespace swept::inline SWEPT_PRECISION
