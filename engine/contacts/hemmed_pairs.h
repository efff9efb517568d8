#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// After the contacts of the step are known: those of `WorldState::hemmed.passing`, and of the probes that were told to
/// pass each other, that are held up become contacts, behind the others; the rest of them have no points in this step.
void holdHemmedPairs(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
