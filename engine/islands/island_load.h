#pragma once

#include <cstdint>

#include "../state/island_loads.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Bodies in the smallest crowd (effort.cpp).
inline constexpr std::uint32_t kFewestInCrowd = 64;

/// Finds the loads of all islands (`WorldState::islandLoads`), and counts down what their bodies owe (search_debt.h).
void findIslandLoads(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
