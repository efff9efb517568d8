#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Rigid joints are springs, as stiff as sub-steps can sample. A jerk opens them, which takes energy, and most of that
/// comes back within some steps, as they close. So what they took they may give back: an island that joints hold to
/// something, and that touches nothing, is no faster by it than it was. (Where that was taken for a gain, and taken
/// back, a trebuchet in profile `fast` lost twice as much as its joints did.)

/// What the solve that was booked took from islands, or gave back.
void noteLent(WorldState& world, const TiedGroup& group);
/// Lets islands have what was taken from them in the solves before. @pre what is noted of jointed and touching ones
void giveBackLent(WorldState& world, const TiedGroup& group);
/// As if the solve had not been, which is made anew: of the island of a body.
void forgetLent(WorldState& world, std::uint32_t slot);

}  // namespace swept::inline SWEPT_PRECISION
