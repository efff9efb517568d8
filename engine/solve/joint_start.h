#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Joints that hold something since the last step begin with the impulses that keep what hangs on them in balance, in
/// islands that are at rest and stay so, and whose joints are iterated. So they carry their load at once, not up to
/// twice as much in the first steps. What moves, or is about to, is too large or too tangled begins without.
/// @pre efforts are assigned, and some joint is new
void startJoints(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
