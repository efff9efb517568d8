#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether two shapes may collide at all: bodies, filters, joints. (Joints hide nothing from sensors: what hangs on the
/// level is seen by the sensors of the level.)
bool mayTouch(const WorldState& world, const Shape& a, const Shape& b);

}  // namespace swept::inline SWEPT_PRECISION
