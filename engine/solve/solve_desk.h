#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct SolveDesk;
struct WorldState;

/// What it left becomes that of the step.
void clearDesk(WorldState& world, SolveDesk& desk);

}  // namespace swept::inline SWEPT_PRECISION
