#pragma once

#include <cstddef>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// What boxes, contacts and continuous collision ask about the size of a body: `Body::extent`, `widest` and `radius`,
/// and of its shapes the radius about its centre. Of all its shapes.
void measure(WorldState& world, std::uint32_t body);
/// The same after shapes were added to a body that is not dynamic, by a look at these alone.
/// @param first  of them, in the body's list
void measureAdded(WorldState& world, std::uint32_t body, std::size_t first);
/// As a step begins: of the bodies that lost shapes since the last one, and are not dynamic, each once.
void measureAnew(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
