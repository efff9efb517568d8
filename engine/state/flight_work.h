#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <limits>
#include <vector>

#include "../../shapes/cache_line.h"
#include "../../solver/impacts/impact.h"
#include "../../toi/time_of_impact.h"
#include "../containers/boxed_items.h"
#include "../counters.h"
#include "../events.h"
#include "body.h"
#include "chain_passer.h"
#include "no_index.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;
class GroundOnTheWay;

/// A static or kinematic shape that a swept shape may meet.
struct FlightObstacle {
    std::uint32_t own = 0;      ///< slot of the swept body's shape
    std::uint32_t other = 0;    ///< slot of the obstacle
    double level = 0;           ///< separation at which the next impact is looked for, metres
    DVec2 lift{};               ///< overlap at the start, undone along the contact normal for the sweep
    bool isClear = false;       ///< the sweep is known not to meet it
    bool isSunkInto = false;    ///< deeper than what contacts hold may be
    bool isBehind = false;      ///< a chain segment that the shape is behind at the start of the sweep
    bool isCrossed = false;     ///< a chain segment that the sweep gets to from behind (chain_crossing.h)
    bool hasOwnNormal = false;  ///< where they met last: that of a face of the swept shape, not of the obstacle
    Real height = -std::numeric_limits<Real>::infinity();  ///< at the start it is known to be as far away, metres
};

/// Something static that a flyer met just now, and is not below its target of.
struct MetGround {
    std::uint32_t own = 0;  ///< slots, as in `FlightObstacle`
    std::uint32_t other = 0;
    Vec2 normal{};  ///< towards the flyer
};

/// What a flyer slides along: a kinematic body that turns, whose surface therefore meets it again and again.
struct TurningRide {
    std::uint32_t body = kNoIndex;  ///< slot of what it met last
    int impacts = 0;                ///< of the ride so far; 0: it did not slide
    double since = 0;               ///< of the last one, seconds of the step
    Vec2 normal{};                  ///< there, towards the flyer
    double sag = 0;                 ///< how far it sinks in until the next one, slops
};

/// Static ground along which a flyer goes since it met it.
struct GroundMetLast {
    std::uint32_t body = kNoIndex;  ///< slot; `kNoIndex`: none, of several bodies, or not known
    Vec2 normal{};                  ///< there, towards the flyer; 0: there is none
    DVec2 center{};                 ///< of the flyer, when it met it, or as the step began
    bool isOfThisStep = false;
};

/// An obstacle by its distance from the start of a sweep.
struct NearObstacle {
    double distanceSquared = 0;  ///< of its box, m²
    std::uint32_t index = 0;
    auto operator<=>(const NearObstacle&) const = default;
};

/// What shapes are in of chains that they got to from behind (chain_crossing.h). One life of it is a flight, an island
/// that advances, or the way of a body that the solver moved:
/// - `beginCrossings`: `crossings` are what its shapes were in as the step began, and all that they are in. (The way of
///   the solver begins without; what its body was in as the step began counts beside `crossings`, then.)
/// - A sweep that does not stop at a segment, since it comes from behind, leaves it in `fromBehind`.
/// - `noteCrossings`, when it has gone on: of both lists what it still is in becomes `crossings`.
/// - `endCrossings`: these join `crossed`, which the world takes over as the step ends. All else is forgotten.
struct ChainCrossings {
    std::vector<ChainPasser> fromBehind;      ///< that the last sweep does not stop at
    std::vector<ChainPasser> crossings;       ///< what shapes are in
    std::vector<ChainPasser> stillCrossings;  ///< scratch of `noteCrossings`
    bool knowsCrossings = false;              ///< it began: `crossings` are all
    bool meetsBacks = false;                  ///< since it was taken back, a search found something of either kind
    std::vector<ChainPasser> crossed;         ///< of all lives of this step that ended
};

/// Two constraints of an impact whose outermost points stand in one of them (flush_impacts.h).
struct FlushImpact {
    ContactConstraint both;
    std::uint32_t own = 0;    ///< place of the constraint of the first point
    std::uint32_t guest = 0;  ///< likewise, of the second one
    std::uint32_t pointOfOwn = 0;
    std::uint32_t pointOfGuest = 0;
};

/// What one worker needs for sweeps, and what it found: kept for its capacity, merged after the parallel loop. Nothing
/// of it shares a cache line with another worker's: they lie side by side, and are written all the time.
struct alignas(kCacheLine) FlightScratch {
    std::vector<FlightObstacle> obstacles;
    WorldTransform startPose;  ///< of the body, at the start of the sweep that they were found for; if there are any
    std::vector<NearObstacle> nearest;
    std::vector<MetGround> met;  ///< since the flyer moved last
    std::vector<std::uint32_t> found;
    std::vector<BoxedItem> movers;  ///< members of an island, by slot (member_meetings.h)
    ChainCrossings chains;
    std::vector<Vec2> normals;
    std::vector<BodyState> states;
    std::vector<BodyInertia> inertias;
    std::vector<ContactConstraint> constraints;
    std::vector<ContactConstraint*> order;
    std::vector<FlushImpact> flushImpacts;
    std::vector<std::uint8_t> isMerged;      ///< scratch: by constraint
    std::vector<std::uint32_t> ofOneGround;  ///< likewise: constraints
    ImpactScratch impact;

    bool isSunk = false;               ///< see `firstImpact`
    GroundOnTheWay* ground = nullptr;  ///< of the island that advances, if kinematic bodies are awake

    std::vector<ContactEvent> events;
    std::vector<LostTimeEntry> lostTime;
    std::vector<ImpactPose> impactPoses;
    StepCounters counters;
};

/// A body in flight: its own copy of its motion, and how much of the step has passed.
struct Flight {
    WorldState* world = nullptr;
    std::uint32_t slot = 0;
    FlightScratch* scratch = nullptr;
    BodyMotion motion{};
    double dt = 0;
    double elapsed = 0;              ///< seconds
    std::array<Vec2, 4> carriers{};  ///< normals of what carries it
    int carrierCount = 0;
    TurningRide ride{};
    GroundMetLast metLast{};
    Real lead = 0;        ///< of the fastest of what is kinematic that it met, m/s
    Real bounceGain = 0;  ///< the most that it got by bouncing off such things as lively as balls do, m/s
    bool stops = false;   ///< mode `stop`: it stays at its first hit

    const Body& body() const;
    Real threshold() const;  ///< slower approaches do not bounce, m/s
    double remaining() const { return dt - elapsed; }
};

}  // namespace swept::inline SWEPT_PRECISION
