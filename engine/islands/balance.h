#pragma once

#include <cstdint>

#include "../../shapes/real.h"
#include "../state/touching.h"
#include "../world_settings.h"

namespace swept::inline SWEPT_PRECISION {

struct IslandRest;
struct WorldState;
struct Body;
struct BodyMotion;

/// Below what bodies rest, and impulses balance what pulls at them. As parts of what gravity gives a body in a step:
/// its speed, its weight; lengths as parts of the radius of the smaller one.
struct RestLimits {
    Real speed = 0;
    Real pull = 0;     ///< what impulses and pulls leave of each other
    Real torque = 0;   ///< likewise, with the radius of the body as lever
    Real gap = 0;      ///< at which something may press, and overlap of what does not
    Real overlap = 0;  ///< of what presses
};

/// Of islands that are solved by iteration: how much they may be wrong by when they are set aside (held_islands.h).
/// What rests on a slope within that of its angle of friction stays; what moves more slowly stops.
RestLimits restLimitsFor(Profile profile);

/// Steps from one search in vain to the next, at most; a power of two.
inline constexpr std::uint16_t kLongestPause = 64;

/// Of the island of a body, by slot. @pre `findBalancedIslands` is at work, or found some; the body is awake
IslandRest& restOf(WorldState& world, std::uint32_t slot);
/// Those that an island has to keep.
RestLimits limitsOf(const WorldState& world, const IslandRest& rest);
/// Radius of the smaller one of the bodies of a contact that can move, metres.
Real movedRadius(const WorldState& world, const TouchingPair& pair);

/// How fast what rests may be, m/s.
Real restSpeedOf(const WorldState& world, Real dt);
/// Whether no point of a body was faster than that, at the end of the last step, and none moved farther in it (overlap
/// is pushed out of without speed), unless it was put elsewhere since. @pre `Body::startCenter` and angle are those of
/// the last step
bool isStill(const Body& body, const BodyMotion& motion, Real restSpeed, Real dt);

/// Finds out which islands are still and in balance: what acts on each body in this step is, but for `RestLimits`,
/// undone by the impulses that its contacts had in the last one. These are impulses that contacts and friction can
/// give, so that to stay where it is, is a solution of the equations of motion, whatever method found it. Where they
/// leave something, others are sought (load_paths.h), now and then.
/// @return whether there are any: those that are not restless in `WorldState::islandRests`, by root
bool findBalancedIslands(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
