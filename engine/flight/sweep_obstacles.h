#pragma once

#include <algorithm>
#include <optional>
#include <span>

#include "../state/tolerances.h"
#include "../state/world_state.h"
#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// World pose of a body at a fraction of a sweep.
BodyMotion motionAt(const Sweep& sweep, double fraction, Vec2 localCenter);
/// Motion of a static or kinematic body within [from, to] seconds of the step, from its pose at the start of the step.
Sweep obstacleSweep(const WorldState& world, std::uint32_t body, double from, double to);

/// Separation at which an impact is resolved, and how exactly it is met, metres.
double targetOf(const WorldState& world, const FlightObstacle& obstacle);
double toleranceOf(const WorldState& world, const FlightObstacle& obstacle);
/// The latter by the former.
inline double toleranceOf(const WorldState& world, double target) {
    const std::optional<Real>& wanted = world.settings.toiTolerance;
    return wanted ? std::min(static_cast<double>(*wanted), target / 2) : target / 4;
}
/// How far ground may be uneven that counts as flush, and how far a body may sag between two impacts of a contact that
/// carries it, metres.
inline Real slopOf(const Shape& own, const Shape& other) { return kTargetRatio * std::min(own.extent, other.extent); }
inline Real slopOf(const WorldState& world, const FlightObstacle& obstacle) {
    return slopOf(world.shapes[obstacle.own], world.shapes[obstacle.other]);
}
/// Largest error of a manifold's separation (`Real`) against that of the sweeps (double), metres.
inline Real roundingOf(const Shape& own, const Shape& other) {
    return std::min(kFlightRoundings * kEpsilon * (own.size + other.size), slopOf(own, other));
}
inline Real roundingOf(const WorldState& world, const FlightObstacle& obstacle) {
    return roundingOf(world.shapes[obstacle.own], world.shapes[obstacle.other]);
}
/// Separation up to which what the sweeps met shows up in a manifold, metres.
Real reachOf(const WorldState& world, const FlightObstacle& obstacle);
/// Separation at which what has this separation, and was dealt with, counts as met again, metres.
double levelInContact(const WorldState& world, const FlightObstacle& obstacle, double separation);

/// How far a body may sink into what the solver holds it off, metres.
inline double slackOf(const Shape& own, const Shape& other) {
    return static_cast<double>(slopOf(own, other) * (kSlackRatio / kTargetRatio));
}
inline double slackOf(const WorldState& world, const FlightObstacle& obstacle) {
    return slackOf(world.shapes[obstacle.own], world.shapes[obstacle.other]);
}

/// Box of all places of a shape on the path of its body, however that turns.
Aabb boxOfPath(const Shape& own, const Sweep& sweep);
/// Likewise of all that is no farther from the centre than that, metres.
Aabb boxOfPath(const Sweep& sweep, double reach);
/// Static and kinematic shapes in the way of a sweep of the body, in order of their slots.
/// Of kinematic ones, an island that advances meets them (`FlightScratch::ground`).
/// @param from  seconds of the step at which it begins: a chain that moves is where it is by then
void findObstacles(const WorldState& world, std::uint32_t body, const Sweep& sweep, double from,
                   FlightScratch& scratch);

/// Manifold of an obstacle (as A) and the swept shape (as B) at given poses.
Manifold obstacleManifold(const WorldState& world, const FlightObstacle& obstacle, const WorldTransform& other,
                          const WorldTransform& own, Real margin);

/// Obstacles that a body touches at the start of the step, and that the contact solver therefore holds it off, may be
/// sunk into by a part of the extent: the solver is soft, and a body that rolls or tips about a contact must not stop
/// there.
void allowSlack(const WorldState& world, const Sweep& sweep, double dt, FlightScratch& scratch);

/// How far a body may sink into what it just met before that counts as met again, in slops.
inline constexpr Real kChatterSlops = Real(1) / 8;
/// How far a body sags between two impacts of what carries it, in slops.
inline constexpr double kSagSlops = 0.5;
/// What a bullet rides on: see `rideSag`.
inline constexpr double kMostSagSlops = 64;
inline constexpr int kImpactsPerDoubling = 4;

/// How far a bullet and what it rides on may sink into each other between two impacts, metres. Ever farther in one
/// step, up to a sixteenth of the extent: something that whirls then gets on by three radians in 64 impacts, however
/// fast.
/// @param impacts  that there were in this step
double rideSag(const WorldState& world, const FlightObstacle& obstacle, int impacts);

/// Obstacles that carry the flyer, along these normals, and all that is flush with them, may be sunk into by a part of
/// the slop. @param from  seconds of the step at which the sweep begins
void allowSag(const WorldState& world, std::span<const Vec2> normals, double from, FlightScratch& scratch);

/// Likewise, but only shapes of one body, and so many slops.
void allowRide(const WorldState& world, const TurningRide& ride, double from, FlightScratch& scratch);

struct FirstImpact {
    bool hit = false;
    double fraction = 1;
    std::uint32_t obstacle = kNoIndex;  ///< in `FlightScratch::obstacles`, of a hit of all of them
};

/// One obstacle: the first fraction, not after `limit`, at which the sweep meets it; see `firstImpact`.
FirstImpact firstImpactWith(const WorldState& world, const Sweep& sweep, const Sweep& otherSweep,
                            FlightObstacle& obstacle, double limit, FlightScratch& scratch, bool ignoresSunk = false);

/// First obstacle that the sweep meets. Obstacles within their target at the start are looked for at a lower separation
/// (their approach was dealt with before), overlapping ones relative to the surface (`lift`).
/// @param from, to  the part of the step that the sweep covers, seconds
/// @param limit  nothing after this fraction is looked for
/// @param ignoresSunk  what the body is sunk into deeper than the slack is left out, and `FlightScratch::isSunk` tells
/// so
FirstImpact firstImpact(const WorldState& world, const Sweep& sweep, double from, double to, FlightScratch& scratch,
                        double limit = 1, bool ignoresSunk = false);

}  // namespace swept::inline SWEPT_PRECISION
