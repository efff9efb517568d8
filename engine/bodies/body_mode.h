#pragma once

#include "../state/tolerances.h"
#include "../state/world_state.h"

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

}  // namespace swept::inline SWEPT_PRECISION
