#pragma once

#include "../bodies/body_mode.h"
#include "../state/world_state.h"

/// What the continuous modes (`ContinuousMode`) have to do beside the sweeps of `stop` and `subStep`. Which mode that
/// is: body_mode.h.

namespace swept::inline SWEPT_PRECISION {

/// In the step, before anything looks at speeds. `speedLimit` (mode_speed_limit.cpp) slows what is too fast,
/// `speculative` (mode_speculative.cpp) has the boxes of its bodies span their whole motion.
void limitSpeeds(WorldState& world, double dt);
void reachAhead(WorldState& world);
/// `speedLimit` again, after the solve: what other bodies pushed does not go farther than it may either.
void limitWays(WorldState& world, double dt);
/// What the limit took from a body at several moments of the step becomes one line of lost time: the parts of its way
/// that were left to it multiply, so that it loses no more than the step.
void joinCaps(WorldState& world, double dt);
/// Begin and end of what passed sensors within the step, at its time (mode_sensors.cpp).
void sweepSensors(WorldState& world, double dt);

/// Largest speed that any point of the body may have under `speedLimit`, m/s: half the width of the body and of the
/// thinnest wall in a step. A width is the smallest of a shape, radius included: 0 of segments and chains without
/// radius. Infinite while the world has no walls.
Real speedLimitOf(WorldState& world, std::uint32_t body, Real dt);

/// A contact point stands half way between the surfaces, and turns with both bodies. At a distance each body is held at
/// the core of its own shape instead: an impulse would turn it about a point in the air, and the surface of a ball that
/// begins to roll would turn away from what it is about to hit.
/// @param radiusA, radiusB  of the two shapes, metres
void anchorAtCores(ContactConstraint& constraint, Real radiusA, Real radiusB);

}  // namespace swept::inline SWEPT_PRECISION
