#pragma once

#include "../state/world_state.h"

/// What is left of a frame after whole steps is a step of its own in many a game, and may be a thousandth of those.
/// What contacts and joints carry in it says hardly anything about a step a thousand times as long: its errors would be
/// so many times as large there, and to begin without any load lets all sink in that a frame has to lift again. So they
/// go on after it with what they carried in the whole step before.

namespace swept::inline SWEPT_PRECISION {

/// Whether the step that begins is such a one: less than half as long as a whole one, together with those since then no
/// longer. (In slow motion, steps are whole ones from then on.)
void noteStepLength(WorldState& world, double dt);

/// As such a step is about to be solved.
void rememberLoads(WorldState& world);
/// As it ends.
void goOnWithLoads(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
