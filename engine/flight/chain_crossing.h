#pragma once

#include <cstdint>

#include "../state/world_state.h"

/// What a sweep does about chains. A chain is solid for what comes from its front alone, and within a step a fast body
/// gets behind a segment and through it. So at the moment of its first contact the middle of the shape decides: what is
/// behind passes. And who is in a chain that it passes gets to the next segments along their own front, as who rolls
/// through the end of a loop: these it passes as well, until it is out.

namespace swept::inline SWEPT_PRECISION {

/// Whether the shape is in the segment already, and came from behind.
bool isCrossing(const WorldState& world, const FlightScratch& scratch, std::uint32_t shape, std::uint32_t segment);

/// Where a shape is that touches a segment.
enum class ChainSide : std::uint8_t {
    front,
    back,       ///< or in the chain that it came to from behind: it passes
    neighbour,  ///< at a corner, in front of the neighbour beyond it: that is what stops it
};
/// @param fraction  of the sweep, at which it touches first
/// @pre the obstacle is a chain segment
ChainSide sideAt(const WorldState& world, const FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep,
                 double fraction, const FlightScratch& scratch);

/// Of the segments that the last sweep, which began at `from`, got to from behind, and of those that a shape of it was
/// in already: notes the ones that it is still in at a fraction of it, and forgets the others.
/// @param from, to  the part of the step that the sweep covers, seconds
void noteCrossings(const WorldState& world, std::uint32_t body, const Sweep& sweep, double from, double to,
                   double fraction, FlightScratch& scratch);

/// From here on, shapes of the body cross what they are noted for alone: what they were in as the step began is noted.
void beginCrossings(const WorldState& world, std::uint32_t body, FlightScratch& scratch);
/// What it crosses as the step ends is for the next step.
void endCrossings(FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
