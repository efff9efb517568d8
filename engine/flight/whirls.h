#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// A flipper: what turns about a hinge on what is not dynamic, its only joint, by more than a little within the
/// step, or is about to, since a motor, a spring or a torque drives it, with a bullet in its way. Solved in one piece
/// it would go by the chord of its arc, and strike the bullet once, with no more than it weighs. So it advances
/// together with that (island_advance.h), in parts that turn it by little: it is swept against the bullet, which then
/// lies on it, is driven on with it, and slides outwards as it turns.

/// Radians within a part of the step: up to so much, it pushes in the direction of the part's beginning.
inline constexpr double kWhirlTurn = 1.0 / 32;

/// Those of this step, into `BulletWork::whirls`; the bullets in their ways, which wake, into `BulletWork::ahead`.
/// @pre there are none of the step before
/// @pre the motions of all that is awake were noted; `JointChains` are current
void findWhirls(WorldState& world, Real dt);

bool isWhirl(const WorldState& world, std::uint32_t slot);
/// rad/s at which the fastest of the members whirls within the step, at least; 0: none does, or there are too many
/// of them to go through the step in so many parts.
double fastestWhirl(const WorldState& world, std::span<const std::uint32_t> members);

}  // namespace swept::inline SWEPT_PRECISION
