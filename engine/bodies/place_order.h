#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Puts bodies into an order in which those that are near each other follow each other: along a curve that fills the
/// plane (G. M. Morton 1966).
void orderByPlace(WorldState& world, std::vector<std::uint32_t>& slots);

}  // namespace swept::inline SWEPT_PRECISION
