#pragma once

#include <cstddef>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct Shape;
struct WorldState;

/// A sensor and another shape that move farther past each other in a step than this, of the smaller of the two, are
/// followed through it; less, and what begins or ends in between is told where they stand as the next step begins, or
/// was so short that nobody need know. Metres: a part of the width, of what is as thin as a line of its length.
Real leastPassed(const Shape& shape);

/// What boxes, contacts, sensors and continuous collision ask about the size of a body: `Body::extent`, `widest`,
/// `radius`, `reach`, `leastPassed` and `hasSensor`, and of its shapes the radius about its centre. Of all its shapes.
void measure(WorldState& world, std::uint32_t body);
/// The same after shapes were added to a body that is not dynamic, by a look at these alone.
/// @param first  of them, in the body's list
void measureAdded(WorldState& world, std::uint32_t body, std::size_t first);
/// As a step begins: of the bodies that lost shapes since the last one, and are not dynamic, each once.
void measureAnew(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
