#pragma once

#include <cstddef>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct Body;
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
/// Which measures of its body a shape has, one bit each: as long as a shape is left that has them, they stay.
/// @pre the body is measured, but for shapes that it lost
std::uint32_t measuresAttained(const Body& body, const Shape& shape);
/// All of them, and more than any shape has: all shapes have to be looked at.
inline constexpr std::uint32_t kAllMeasures = ~0U;
/// Shapes of a body that is not dynamic are gone, or changed.
/// @param attained  of those that are gone, before they went
void noteLoss(WorldState& world, std::uint32_t body, std::uint32_t attained);
/// As a step begins: of the bodies that are not dynamic and lost shapes since the last one that may have been the only
/// ones of some measure, each once.
void measureAnew(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
