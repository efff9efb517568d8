#pragma once

#include "../state/world_state.h"
#include "solve_desk.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts keep their normals for a whole solve, so what rides on curved ground goes straight on in it, along the
/// ground as that was at the start: v²t²/2ρ into the curve. Then it is pushed out, without speed, which lifts it at no
/// cost; and where it is going by then, across the new normal, is lost. To a ball in a shallow bowl the lift is more:
/// it climbed from turn to turn, until it left the bowl. In a steep one the loss is. So what rides by itself pays for
/// that lift, and if it is round gets back what turning took from it. Neither ever makes energy.
///
/// Of a body that nothing dynamic touches and no joint holds, after a solve: changes its speed, not where it is going.
/// @param state  what the solve made of it; its motion in the world is still that of before
/// @param time   that was solved for, s
void followCurve(const WorldState& world, std::uint32_t slot, Body& body, BodyState& state, Real time);

/// What rides on a chain with others, jointed or touching, is lifted in the same way: each member goes as straight as
/// its ground, or what bears it, has it. So the island pays for the lift of all of them, out of the motion of all; but
/// never for more than it gained beyond the work of gravity, forces and springs.

/// Whether some island may have been lifted so.
bool mayRideTogether(const WorldState& world, const SolveDesk& desk);
/// @pre accounts know what feeds the islands, what springs gave, and the ground that they press on
void payForLift(WorldState& world, SolveDesk& desk, double time);

/// Whether a body may ride by itself.
inline bool mayRide(const Body& body) {
    if (!body.hasContact || body.touchesDynamic) { return false; }
    return body.holdingJoints == 0 && body.inverseMass > 0;
}

}  // namespace swept::inline SWEPT_PRECISION
