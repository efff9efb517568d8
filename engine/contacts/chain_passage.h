#pragma once

#include <span>

#include "../state/tolerances.h"
#include "../state/world_state.h"

/// Shapes that come through a chain from its back, as who jumps onto a platform from below. A chain is solid for a
/// shape as soon as the middle of its core is in front, and half of the shape may be behind it then: pushed out, it
/// would be lifted by that much. So the contact of a shape whose middle came to the front while it crossed the segment
/// has no points until the shape is all in front, or its middle behind again. Nor have those of the pieces that it gets
/// to meanwhile, with a part of it behind them: who comes through a door down onto the floor, of the same chain, lands.
/// What is fast gets behind a piece and through it within a step: flight/chain_crossing.h.

namespace swept::inline SWEPT_PRECISION {

/// The mean of the vertices of a core, in the frame of its body: inside, and the centre of boxes and circles.
Vec2 middleOf(const Polygon& core);
/// Whether a place in the frame of its body is on the side of a chain segment that it does not collide on.
inline bool isBehind(const Shape& segment, Vec2 place) {
    return dot(place - segment.segment.p, segment.polygon.normals[0]) < 0;
}

/// Deeper than this part of the extent nothing stands on a chain: what comes to the front so deep came from the back.
inline constexpr Real kPassedRatio = Real(1) / 32;

/// How far a shape is from the plane of a chain segment, by its lowest point, metres.
Real heightOver(const Shape& segment, const WorldTransform& ofChain, const Shape& own, const WorldTransform& ofShape);
/// What is in one piece of a chain, or behind it, and gets to another one in front of its middle.
struct ChainArrival {
    Real height = 0;  ///< `heightOver` the other one
    Vec2 normal{};    ///< of that, world
    Vec2 towards{};   ///< as it is touched first: from that to the shape, unit, world; 0: it may be in it already
    Vec2 velocity{};  ///< of the middle, seen from that; in any unit
    Real extent = 0;  ///< of both
};
/// Whether it gets there from behind: some of it is there. Else it comes down onto its front, as who comes through a
/// door onto the floor.
bool comesAlong(const ChainArrival& arrival);

/// Whether chains with these segments may go on as each other: where their bodies move, they are of one body.
bool canBeJoined(const WorldState& world, const Shape& a, const Shape& b);
/// Whether two segments (slots) of a chain, or of one and the one that it goes on as, hang together for a shape: a loop
/// that comes down behind the floor from which it rose is the same chain, but nobody goes over a corner from one to the
/// other.
/// @param middle  of the shape, in the frame of the first one
bool hangTogether(const WorldState& world, const Shape& own, Vec2 middle, std::uint32_t a, std::uint32_t b);

/// When it is asked. `startCenter` and `startAngle` of bodies tell where they were before as a step begins, and only
/// then: parts of a step begin with those of their members set to where these are, and of chains that move they do not.
enum class Moment : std::uint8_t { stepBegins, partBegins };

/// Takes the points of contacts that pass a chain.
/// @param crossing  what sweeps found to be in a segment, from behind, in order
/// @param renewed  indices of the contacts whose manifold is new, in their order
/// @param byBody  scratch: those with chains
/// @return whether there were any
bool letThrough(const WorldState& world, std::span<Contact> contacts, std::span<const std::uint32_t> renewed,
                Moment moment, std::span<const ChainPasser> crossing, std::vector<std::uint64_t>& byBody);
/// Those of the world, which are listed for the sweeps of this step.
void letThrough(WorldState& world);
/// Whether a shape passes a chain segment (slots) in this step.
bool passesChain(const WorldState& world, std::uint32_t shape, std::uint32_t segment);

}  // namespace swept::inline SWEPT_PRECISION
