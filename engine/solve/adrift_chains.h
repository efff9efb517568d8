#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Joints push two bodies alike, but where they have a gap, at two points: so a solve turns what they tie together from
/// nothing, a little more in each. (Of random trees of two to seven bodies that spin freely, masses up to 30 : 1, a
/// fifth was off by more than 2 % of its angular momentum after 10 s in profile `fast`, and some spun up to seven times
/// the energy.) Contacts between its own bodies do so, too: within a step they keep their arms and normals. (A plate of
/// 64 welded tiles, flush with each other, lost half of its spin within 5 s at 3 rad/s in `accurate`.) What drifts,
/// held and touched by nothing else, turns as a whole as what pulls at it says: its velocities are put right by a turn
/// of all of it, which no joint minds.
///
/// After a solve, before it is read.
void keepSpinOfAdrift(const WorldState& world, const TiedGroup& group);

}  // namespace swept::inline SWEPT_PRECISION
