#pragma once

#include "../state/world_state.h"

/// The joints that bodies have, and how one is removed from them.

namespace swept::inline SWEPT_PRECISION {

/// Slots of the joints of one of two bodies (ground may have thousands): all between the two are among them, and all
/// gears on these, which are listed at the bodies of both their joints.
std::span<const std::uint32_t> fewerJoints(const WorldState& world, std::uint32_t bodyA, std::uint32_t bodyB);
/// Of the two that a joint may keep apart the one by whose shapes their pairs are found sooner.
std::uint32_t bodyOfFewerShapes(const WorldState& world, const Joint& joint);
/// Whether all of its bodies are enabled, and what it moves is dynamic: A or B, of a mouse joint B. Else it is off.
bool canHold(const WorldState& world, const Joint& joint);
/// Removes a joint and the gears it is part of, wakes their bodies, and lets them collide again.
/// @param leaving  slot of a body that is about to be destroyed: nothing will meet it
void removeJoint(WorldState& world, JointId id, std::uint32_t leaving = kNoIndex);

}  // namespace swept::inline SWEPT_PRECISION
