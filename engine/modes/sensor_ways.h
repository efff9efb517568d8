#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/aabb.h"
#include "../../toi/sweep.h"
#include "../state/world_state.h"

/// The ways of bodies through a step, as sensors follow them (mode_sensors.cpp), and how far they are.

namespace swept::inline SWEPT_PRECISION {

/// The impacts of this step by body: it has thousands of them, and all that is awake is asked.
void listImpactsByBody(WorldState& world);
/// Whether a body may move far enough past some sensor, or with one past something, to be followed. Cheap, and rather
/// yes than no: of two of which neither may, the way of one past the other is no farther than `leastPassed` of either.
bool mayPassUnseen(const WorldState& world, std::uint32_t body, double dt);
/// Of two shapes: whether they move so far past each other, or one of them hit something.
bool passesUnseen(const WorldState& world, const SensorPair& pair, double dt);

/// Start, impacts and end of a body's way in this step.
void findWaypoints(const WorldState& world, std::uint32_t body, std::vector<Waypoint>& points);
/// The way between two fractions that have no waypoint between them. What flies goes as it did for what it hits.
Sweep wayBetween(const WorldState& world, std::uint32_t body, const std::vector<Waypoint>& points, double from,
                 double to, double dt);
/// Whether a body has no impacts, and comes near none of these boxes on its way. Cheap, and rather no than yes.
bool isClearOnWay(const WorldState& world, std::uint32_t body, std::span<const Aabb> boxes, double dt);
/// Holds a shape of the body wherever it turns along the straight lines between its waypoints, and so much room.
Aabb boxOfWay(const WorldState& world, const Shape& shape, const std::vector<Waypoint>& points, Real room);
/// By how much the way leaves the straight lines between its waypoints, metres.
double bulgeOfWay(const WorldState& world, std::uint32_t body, const std::vector<Waypoint>& points, double dt);

}  // namespace swept::inline SWEPT_PRECISION
