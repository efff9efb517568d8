#pragma once

#include "world_settings.h"

namespace swept::inline SWEPT_PRECISION {

/// What a profile means where the settings leave it open.
inline constexpr int kAccurateSubSteps = 16;
inline constexpr int kFastSubSteps = 4;
/// Two passes: with one, redundant points (a box against a wall of flush pieces) keep up to a quarter of the speed with
/// which the soft push parted them.
inline constexpr int kAccurateRelaxPasses = 2;
inline constexpr int kFastRelaxPasses = 1;

constexpr int subStepsOf(const WorldSettings& settings) {
    if (settings.subSteps > 0) { return settings.subSteps; }
    return settings.profile == Profile::accurate ? kAccurateSubSteps : kFastSubSteps;
}

constexpr int relaxPassesOf(const WorldSettings& settings) {
    if (settings.relaxPasses >= 0) { return settings.relaxPasses; }
    return settings.profile == Profile::accurate ? kAccurateRelaxPasses : kFastRelaxPasses;
}

}  // namespace swept::inline SWEPT_PRECISION
