#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether a body that touches a chain comes to where that turns towards it within the step, so fast that a contact,
/// which keeps its normal for a step, would let it in too far to be swept out again (`kShallowRatio`).
/// @pre B is dynamic
bool meetsCurve(const WorldState& world, const Contact& contact, Real dt);

}  // namespace swept::inline SWEPT_PRECISION
