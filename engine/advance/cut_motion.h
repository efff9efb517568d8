#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// A solved part of a step is cut short: the body stands where it was at a fraction of it, and has the velocities of
/// then. What impulses gave it stays, since nothing tells when. What forces, torques and damping gave it in the rest of
/// the part is taken back, as they do that again in the next one; unless something bore them, as ground bears a weight.
/// @param before    as the part began, which is awake and dynamic
/// @param time      of the part, s
/// @param fraction  of the part, in (0, 1)
void cutMotion(WorldState& world, std::uint32_t body, const BodyMotion& before, double time, double fraction);

}  // namespace swept::inline SWEPT_PRECISION
