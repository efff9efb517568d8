#pragma once

#include "solver_batch.h"

namespace swept::inline SWEPT_PRECISION {

/// Limits and lengths that move go on for h seconds, as the bodies do.
void moveLimits(SolverBatch& batch, Real h);

}  // namespace swept::inline SWEPT_PRECISION
