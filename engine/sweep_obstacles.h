#pragma once

#include "flight.h"
#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {

ToiPolygon toiPolygonOf(const Polygon& polygon);
/// World pose of a body at a fraction of a sweep.
BodyMotion motionAt(const Sweep& sweep, double fraction, Vec2 localCenter);
/// Motion of a static or kinematic body within [from, to] seconds of the step, from its pose at the start of the step.
Sweep obstacleSweep(const WorldState& world, std::uint32_t body, double from, double to);

/// Target and tolerance of a pair, metres.
double targetOf(const WorldState& world, const FlightObstacle& obstacle);
double toleranceOf(const WorldState& world, const FlightObstacle& obstacle);

/// Static and kinematic shapes in the way of a sweep of the body, in order of their slots.
void findObstacles(const WorldState& world, std::uint32_t body, const Sweep& sweep, FlightScratch& scratch);

/// Manifold of an obstacle (as A) and the swept shape (as B) at given poses.
Manifold obstacleManifold(const WorldState& world, const FlightObstacle& obstacle, const WorldTransform& other,
                          const WorldTransform& own, Real margin);

/// Obstacles that a body touches at the start of the step, and that the contact solver therefore holds it off, may be
/// sunk into by a part of the extent: the solver is soft, and a body that rolls or tips about a contact must not stop there.
void allowSlack(const WorldState& world, const Sweep& sweep, double dt, FlightScratch& scratch);

struct FirstImpact {
    bool hit = false;
    double fraction = 1;
    std::size_t obstacle = 0;  ///< index in the scratch
};

/// First obstacle that the sweep meets. Obstacles within their target at the start are looked for at a lower separation
/// (their approach was dealt with before), overlapping ones relative to the surface (`lift`).
/// @param from, to  the part of the step that the sweep covers, seconds
FirstImpact firstImpact(const WorldState& world, const Sweep& sweep, double from, double to, FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
