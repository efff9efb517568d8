#pragma once

#include "world_settings.h"

namespace swept::inline SWEPT_PRECISION {

/// What a profile means where the settings leave it open.
inline constexpr int kAccurateSubSteps = 16;
inline constexpr int kFastSubSteps = 4;
inline constexpr int kRelaxPasses = 1;

constexpr int subStepsOf(const WorldSettings& settings) {
    if (settings.subSteps > 0) { return settings.subSteps; }
    return settings.profile == Profile::accurate ? kAccurateSubSteps : kFastSubSteps;
}

constexpr int relaxPassesOf(const WorldSettings& settings) {
    return settings.relaxPasses >= 0 ? settings.relaxPasses : kRelaxPasses;
}

}  // namespace swept::inline SWEPT_PRECISION
