#pragma once

#include <cstdint>

#include "../state/world_state.h"

/// What a sweep does about chains. A chain is solid for what comes from its front alone, and within a step a fast body
/// gets behind a segment and through it. So at the moment of its first contact the middle of the shape decides: what is
/// behind passes. And who is in a chain that it passes gets to the next segments along their own front, as who rolls
/// through the end of a loop: these it passes as well, until it is out.

namespace swept::inline SWEPT_PRECISION {

/// Where a shape is as a sweep begins, for the chains in its way: what is near one piece of them is near several.
class StartAtChains {
public:
    /// @param pose  of its body as the sweep begins
    /// @param from  seconds of the step at which it does
    StartAtChains(const WorldState& world, std::uint32_t shape, const WorldTransform& pose, double from)
        : world_(world), shape_(shape), pose_(pose), from_(from) {}

    /// Whether it is behind a segment, by the middle of its core, as in the manifold.
    bool isBehind(std::uint32_t segment);
    /// Whether it is in the segment already, and came from behind.
    bool isCrossing(std::uint32_t segment, const FlightScratch& scratch) const;

private:
    const WorldState& world_;
    std::uint32_t shape_;
    const WorldTransform& pose_;
    double from_;
    Vec2 middle_{};  ///< of its core, in the frame of the chains of this body:
    std::uint32_t chainBody_ = kNoIndex;
};

/// Whether what a sweep touches first there is a chain that lets the shape pass. From then on it is no obstacle of that
/// sweep, and what was met from behind is noted.
/// @param fraction  of the sweep, at which it touches
bool passesFromBehind(const WorldState& world, FlightObstacle& obstacle, const Sweep& sweep, const Sweep& otherSweep,
                      double fraction, FlightScratch& scratch);

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
