#pragma once

#include <span>

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Rigid joints are springs, as stiff as sub-steps can sample. A jerk opens them, which takes kinetic energy, and most
/// of that comes back within some steps, as they close. So what opening them took they may give back. (Where that was
/// taken for a gain, and taken back, a trebuchet in profile `fast` lost twice as much as its joints did.)
///
/// What a solve took is known to be lent only where nothing else takes energy: of a chain that joints alone hold to
/// something static, which touches nothing, has neither motors, springs nor damping, and none of whose joints a call
/// moved. What is otherwise in a solve has no loan after it. The loan is the chain's (`JointChain::lent`) as long as
/// its joints are the same.

/// What the solve that was booked took, or gave back, and what joints may have given back in it.
/// And what small gains added up to, where that is known (chain_balance.h).
/// @param time  that was solved for, s
/// @param dt    of the step that it is part of, s
/// @pre some chain may lend
void noteLent(WorldState& world, const TiedGroup& group, Real time, double dt);

/// The loan of an island with joints that advances by itself, for who takes its solves back; null of others. What has
/// one is a single chain: of several that touch each other none has.
LentEnergy* lentOf(WorldState& world, std::span<const std::uint32_t> joints);

/// Of chains that were found anew, those that are as they were before keep their loans.
void keepLent(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
