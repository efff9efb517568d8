#pragma once

#include "../state/tolerances.h"
#include "../state/world_state.h"

/// What the continuous modes (`ContinuousMode`) have to do beside the sweeps of `stop` and `subStep`.
///
/// A body's own mode goes before the world's. Each body keeps to its own: where two modes meet in a pair, what the more
/// careful one does is done for both. A speculative body makes the contact ahead, and it holds its partner too; a swept
/// body stops at, or bounces off, a static or kinematic body whatever the mode of that is.

namespace swept::inline SWEPT_PRECISION {

inline ContinuousMode modeOf(const WorldState& world, const Body& body) {
    return body.def.continuous.value_or(world.settings.continuous);
}

/// Whether fast bodies of this mode are swept against what they may hit.
constexpr bool isSwept(ContinuousMode mode) { return mode == ContinuousMode::stop || mode == ContinuousMode::subStep; }

/// Whether a body is a bullet that flies freely, and fast as such. @param motion  of some point in the step, metres
inline bool isFastFreeBullet(const WorldState& world, const Body& body, Real motion) {
    const bool isFree = !body.hasContact && body.holdingJoints == 0;
    if (!isFree || !(motion > kFastBulletRatio * body.extent)) { return false; }
    return body.isDynamic() && body.def.bullet && modeOf(world, body) == ContinuousMode::subStep && body.extent > 0;
}

/// Whether a mode has anything to do before and after the solve.
constexpr bool isWatched(ContinuousMode mode) {
    return mode == ContinuousMode::speedLimit || mode == ContinuousMode::speculative;
}

/// In the step, before anything looks at speeds. `speedLimit` (mode_speed_limit.cpp) slows what is too fast,
/// `speculative` (mode_speculative.cpp) has the boxes of its bodies span their whole motion.
void limitSpeeds(WorldState& world, double dt);
void reachAhead(WorldState& world);
/// `speedLimit` again, after the solve: what other bodies pushed does not go farther than it may either.
void limitWays(WorldState& world, double dt);
/// Begin and end of what passed sensors within the step, at its time (mode_sensors.cpp).
void sweepSensors(WorldState& world, double dt);

/// Largest speed that any point of the body may have under `speedLimit`, m/s: half the width of the body and of the
/// thinnest wall in a step. A width is the smallest of a shape, radius included: 0 of segments and chains without
/// radius. Infinite while the world has no walls.
Real speedLimitOf(WorldState& world, std::uint32_t body, Real dt);

/// Whether only mode `speculative` makes a contact between so distant shapes.
/// @pre the contact has points
bool isAhead(const WorldState& world, const Contact& contact);
/// A contact point stands half way between the surfaces, and turns with both bodies. At a distance each body is held at
/// the core of its own shape instead: an impulse would turn it about a point in the air, and the surface of a ball that
/// begins to roll would turn away from what it is about to hit.
/// @param radiusA, radiusB  of the two shapes, metres
void anchorAtCores(ContactConstraint& constraint, Real radiusA, Real radiusB);

}  // namespace swept::inline SWEPT_PRECISION
