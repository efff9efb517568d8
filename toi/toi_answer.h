#pragma once

#include <optional>

#include "moving_pair.h"

namespace swept::inline SWEPT_PRECISION {

/// The answer that a pose gives: separation, normal and witness points of that very pose, in the world.
Toi answerFrom(const PairPose& pose, const Sweep& sweepA, ToiState state, int iterations);

/// What every method that looks at fraction 0 says there: `overlapped` where the cores intersect, a hit at 0 where the
/// separation is within the target; nothing otherwise.
/// @param pose  at fraction 0.
std::optional<Toi> answerAtStart(const PairPose& pose, const Sweep& sweepA, const ToiSettings& settings);

}  // namespace swept::inline SWEPT_PRECISION
