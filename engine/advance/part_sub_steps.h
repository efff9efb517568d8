#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The shortest part of a step that an island advances by, as a share of it.
inline constexpr double kShortestPart = 1.0 / 128;

/// Of which bodies the spin is asked.
enum class Spinners : std::uint8_t { all, heldByJoints };
/// rad/s, without its sign, of rods that go round as well. Not of wheels on their axles: they look the same however
/// they turn, and hold what is on the axle where it is.
double fastestSpin(const WorldState& world, std::span<const std::uint32_t> members,
                   std::span<const std::uint32_t> joints, Spinners which);

/// Radians that a member may turn in a part: sweeps go straight from pose to pose.
inline constexpr double kMaxTurn = 0.5;
/// Without joints the way of a turning body is straight; only what it looks like from its partner changes.
inline constexpr double kMaxLooseTurn = 2;

/// Whether the first part of an island, and at most one of its parts, is the whole step.
bool isOnePart(const WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> joints,
               double dt);

/// Into how many sub-steps a part of the step goes: at most as many as the whole step would, and enough for joints to
/// follow the turns of what they tie, which an impact may just have begun.
/// @param time  of the part, seconds
int subStepsOfPart(const WorldState& world, const AdvancingIsland& island, double time, double dt);

}  // namespace swept::inline SWEPT_PRECISION
