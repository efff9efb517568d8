#pragma once

#include "../state/world_state.h"

/// Boxes of shapes: what the broadphase has to know of them in the coming step.

namespace swept::inline SWEPT_PRECISION {

/// Box that a shape's proxy must contain in the next step, and the larger one that it is given when it does not.
Aabb neededBox(const WorldState& world, const Shape& shape);
Aabb fatBox(const WorldState& world, const Shape& shape);
/// Hands boxes that are too small for where the shapes may be next to the broadphase.
void updateProxies(WorldState& world, std::uint32_t body);
/// The same after shapes of a dynamic body came or went: without a look at the others as long as theirs stay the same.
/// @param first   of those that came, in the list of the body
/// @param before  as it was before
void updateProxiesFrom(WorldState& world, std::uint32_t body, std::size_t first, const BodyTravel& before);
/// The same for different bodies at the same time, between `Broadphase::beginMoves` and `endMoves`.
void renewBoxes(WorldState& world, std::uint32_t body);
/// Also boxes that still fit, and all their pairs are found anew (teleports).
void renewProxies(WorldState& world, std::uint32_t body);
/// After its velocity changed between steps, or the step became longer: boxes reach as far as the coming step asks.
void reachWithVelocity(WorldState& world, std::uint32_t body);

}  // namespace swept::inline SWEPT_PRECISION
