#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"
#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// World pose of a body at a fraction of a sweep.
BodyMotion motionAt(const Sweep& sweep, double fraction, Vec2 localCenter);
/// Motion of a static or kinematic body within [from, to] seconds of the step, from its pose at the start of the step.
Sweep obstacleSweep(const WorldState& world, std::uint32_t body, double from, double to);

/// Pose of such a body so many seconds after the start of the step.
WorldTransform groundPose(const WorldState& world, std::uint32_t body, double seconds);

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

/// Obstacles that a body touches at the start of its sweep, and that the contact solver therefore holds it off, may be
/// sunk into by a part of the extent: the solver is soft, and a body that rolls or tips about a contact must not stop
/// there.
/// @param from  seconds of the step at which the sweep begins
void allowSlack(const WorldState& world, const Sweep& sweep, double from, FlightScratch& scratch);

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
