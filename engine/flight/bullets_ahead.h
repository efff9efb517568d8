#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Bullets that joints hold advance with their island, which sweeps them against its other members
/// (member_meetings.h): so what they may meet in this step becomes one of these before it begins.

/// What comes near the way of such a bullet, into `BulletWork::ahead`; if it sleeps, it wakes. Told by the velocities
/// of now: what joints and impacts make of them within the step is foreseen as far as a part of that way.
/// @pre the motions of all that is awake were noted; `JointChains` are current
void findAhead(WorldState& world, Real dt);
/// As if they touched already. @pre what woke since has its traits, islands were reset
void tieAhead(WorldState& world);

/// Whether a body is such a bullet.
bool isJointedBullet(const WorldState& world, std::uint32_t slot);
/// Whether a body is swept against the other members of its island: such a bullet, or a whirl (whirls.h).
bool meetsMembers(const WorldState& world, std::uint32_t slot);
bool mayMembersMeet(const WorldState& world, std::span<const std::uint32_t> members);

/// The way of a body in this step if nothing but forces act on it, without its turning; and a box of it, with room for
/// what leads it aside.
Sweep straightPath(const WorldState& world, std::uint32_t slot, Real dt);
Aabb boxAhead(const WorldState& world, std::uint32_t slot, Real dt);
bool mayBodiesTouch(const WorldState& world, std::uint32_t one, std::uint32_t other);

}  // namespace swept::inline SWEPT_PRECISION
