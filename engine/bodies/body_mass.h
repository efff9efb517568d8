#pragma once

#include "../state/world_state.h"

/// What a body weighs and where its centre is, by its shapes; and among which kinds it counts.

namespace swept::inline SWEPT_PRECISION {

/// Notes the masses of shapes that came to a dynamic body, or have another density.
void weigh(WorldState& world, std::span<const std::uint32_t> shapes);
/// Recomputes mass, centre, extent and radius from the shapes; keeps the body frame where it is, and how its points
/// move. @param isBuilt  it gets the shapes that it is made of: its velocity is that of the centre, wherever they put
/// it
void updateMass(WorldState& world, std::uint32_t body, bool isBuilt = false);
/// Recomputes the pose of the body frame from centre and angle.
void updatePose(WorldState& world, std::uint32_t body);
/// Counts a body among those of its kind. @param sign  1, or −1 when it is one of them no longer
void countBody(WorldState& world, const Body& body, std::int32_t sign);

}  // namespace swept::inline SWEPT_PRECISION
