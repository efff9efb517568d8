#pragma once

#include <span>

#include "body_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Makes the rotation of each body that of the angle it has turned by: `rotationFromAngle`, to the bit.
using RotateBodies = void (*)(std::span<BodyState> bodies);

/// For the widest registers that this machine has; null where there are none, see `contactKernels`.
RotateBodies rotationKernel();

}  // namespace swept::inline SWEPT_PRECISION
