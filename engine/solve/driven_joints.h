#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Joints that calls moved: another length, other limits, another target. What they do for some steps is work, as that
/// of a winch: the energy guard (energy_guard.h) took the swing from whatever hung on a rope that was reeled in.

/// @param moved  how far what it holds its bodies to has moved, metres; nothing is noted of what did not
void noteDriven(WorldState& world, JointId joint, Real moved);
/// Before a step: targets set out for where they were set to, and get there at its end.
void beginDriven(WorldState& world, double dt);
/// After a step: targets are there, and what is as good as closed is driven no longer.
void endDriven(WorldState& world);
/// How fast a joint (slot) draws, and does work in this step, as that of a winch, m/s; 0: it does none.
Real woundSpeed(const WorldState& world, std::uint32_t joint);
/// Tells the accounts of the islands of a solve.
void noteDriven(WorldState& world, const TiedGroup& group);

}  // namespace swept::inline SWEPT_PRECISION
