#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "../state/world_state.h"

/// The joints that bodies have, and how one is removed from them.

namespace swept::inline SWEPT_PRECISION {

/// A body that moves, of a joint that holds something: the first of them. All are in the same chain.
/// @pre something of it is awake
inline std::uint32_t movingBodyOf(const WorldState& world, std::uint32_t joint) {
    const JointTie& tie = world.jointTies[joint];
    if (isAwakeDynamic(world, tie.bodyA)) { return tie.bodyA; }
    if (tie.isPair) { return tie.bodyB; }
    const auto bodies = world.joints[joint].allBodies();
    return *std::find_if(bodies.begin(), bodies.end(),
                         [&world](std::uint32_t slot) { return isAwakeDynamic(world, slot); });
}
/// Of two bodies one that is dynamic, if any: of two A.
inline std::uint32_t dynamicBodyOf(const WorldState& world, const JointTie& tie) {
    return world.bodies[tie.bodyA].isDynamic() ? tie.bodyA : tie.bodyB;
}
/// Likewise, of two B: what a joint holds rather than what it is held to.
inline std::uint32_t heldBodyOf(const WorldState& world, const Joint& joint) {
    return world.bodies[joint.bodyB].isDynamic() ? joint.bodyB : joint.bodyA;
}
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
