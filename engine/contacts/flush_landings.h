#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Where a body comes down on several flush pieces of ground at once, as a crate on tiles, each piece has points of its
/// own between the corners of the body. Their impulses depend on each other: iteration that finds them one after the
/// other gives too much, and the body rebounds, with up to a seventh of its speed. But where gaps are in a line the
/// outermost points meet the ground first, however the body turns. So for the step in which they meet these stand in
/// one contact, which is solved exactly, and the solve does without the others. (Shapes of one body that are flush with
/// each other come down so on one floor, too.)
/// @pre `Landings::meeting` are those of this step; it is known what advances with fast islands
void mergeLandings(WorldState& world);

/// After the solve: each contact has its points again, with their impulses, and has struck by itself.
void partLandings(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
