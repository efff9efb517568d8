#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Joints close their gaps by moving bodies without a speed, and where they cannot all hold, one may open another one's
/// the more the longer the lever is on which it turns the body: a bar of 1 m that was hinged, and welded 2 m beside
/// itself at another angle, was moved by metres, then by thousands of kilometres, while its speed was that of rest. An
/// island that goes so much farther than its speeds tell, and opens its joints by that, stays where it was, or goes on
/// as a whole, and its joints begin the next step without impulses.
/// @pre some member leapt; accounts are settled
/// @param time  that was solved for, s
void undoLeaps(WorldState& world, const TiedGroup& group, double time);

}  // namespace swept::inline SWEPT_PRECISION
