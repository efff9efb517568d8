#pragma once

#include <limits>

#include "../../solver/softness.h"
#include "../world_settings.h"
#include "effort.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {

/// What a profile means where the settings leave it open.
inline constexpr int kAccurateSubSteps = 16;
inline constexpr int kFastSubSteps = 4;
/// Two passes: with one, redundant points (a box against a wall of flush pieces) keep up to a quarter of the speed with
/// which the soft push parted them.
inline constexpr int kAccurateRelaxPasses = 2;
inline constexpr int kFastRelaxPasses = 1;
/// Four sub-steps leave crowds deeper in each other than sixteen, so they are pushed out faster than by `kPushRatio`:
/// mean overlaps of `spinner` and `smash` are half of what they were, and there are fewer contacts to solve. (With it a
/// ragdoll that `accurate` takes into a wall gains energy, see FastIslands.ARagdollGainsNoEnergyAtAWall.)
inline constexpr Real kFastPushRatio = 2 * kPushRatio;

/// Of contacts with what is not dynamic: a spring of four times the stiffness, so that what rests there sinks in by a
/// quarter. Ground gives way to nobody, so nothing passes its push on. What all of a stack presses on lies there, and
/// four sub-steps leave that deep enough to be seen; `accurate` solves what rests all at once, without any give.
inline constexpr Real kFastGroundCycles = 2 * kContactCycles;

/// After an impact the next part of an island's step may be so many times as long as the one before.
inline constexpr double kAccurateGrowth = 4;
/// With four, an island that met something early in the step took a third more parts in scene `spinner`. (With sixteen
/// in `accurate`, ragdolls that fell on each other in scene `rain` were 54 mm deep in each other, instead of 5.)
inline constexpr double kFastGrowth = 16;

constexpr int subStepsOf(const WorldSettings& settings) {
    if (settings.subSteps) { return *settings.subSteps; }
    return settings.profile == Profile::accurate ? kAccurateSubSteps : kFastSubSteps;
}

constexpr int relaxPassesOf(const WorldSettings& settings) {
    if (settings.relaxPasses) { return *settings.relaxPasses; }
    return settings.profile == Profile::accurate ? kAccurateRelaxPasses : kFastRelaxPasses;
}

/// Fastest push out of an overlap: this part of the pair's extent per step.
constexpr Real pushRatioOf(const WorldSettings& settings) {
    return settings.profile == Profile::accurate ? kPushRatio : kFastPushRatio;
}

/// Oscillations in a sub-step of contacts with what is not dynamic.
constexpr Real groundCyclesOf(const WorldSettings& settings) {
    return settings.profile == Profile::accurate ? kContactCycles : kFastGroundCycles;
}

constexpr double growthOf(const WorldSettings& settings) {
    return settings.profile == Profile::accurate ? kAccurateGrowth : kFastGrowth;
}

constexpr bool hasErrorBudget(const WorldSettings& settings) {
    constexpr Real kNone = std::numeric_limits<Real>::infinity();
    return settings.maxPenetration < kNone || settings.maxJointError < kNone;
}

/// Of a step that is not cut into parts. The springs of contacts and joints are as stiff as these sub-steps can sample:
/// with a budget their own, since what they give way is the error.
constexpr int standardSubSteps(const WorldSettings& settings, Effort effort) {
    const int usual = subStepsOf(settings);
    return hasErrorBudget(settings) ? subStepsFor(effort, usual) : usual;
}

}  // namespace swept::inline SWEPT_PRECISION
