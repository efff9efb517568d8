#pragma once

#include "../state/world_state.h"

/// Bodies that something heavy and fast is about to strike, and those near them. Contacts are made as far ahead of a
/// body as it moves in a step, which is next to nothing where it rests. Struck by what is much heavier it is thrown at
/// its neighbours within the same step, though, which no contact knew of, and so it ended that step deep inside them.
/// (A ball of 300 times their mass fell onto forty balls by 3 m: two of these were in each other by nearly all of their
/// size.) So contacts reach ahead of stirred bodies, too, and what is held in balance is released before it is struck.
///
/// A blow is what a body may move in the step. It is handed on to all that is near, as the speed that what it went
/// through and what it comes to would have in common. Only profile `accurate` looks for it: where little is so fast and
/// so heavy, with all that it leads to, it takes less than a hundredth of a step.

namespace swept::inline SWEPT_PRECISION {

/// Finds those of this step, in profile `accurate`; in others there are none.
/// @pre what is awake has its boxes; pairs of this step are not found yet
void findStirred(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
