#include <limits>

#include "free_motion.h"
#include "solver.h"

/// What joints alone hold, each island by itself.

namespace swept::inline SWEPT_PRECISION {

SolveReport Solver::solveIslands(SolverBatch& batch, const SolverSettings& settings, TaskSystem& loops) {
    SolveReport report{.isDirect = true, .isExact = true};
    const Real h = settings.dt / static_cast<Real>(settings.subSteps);
    islands_.solve(batch, h, settings.subSteps, loops, report);
    if (settings.maxSpeed < std::numeric_limits<Real>::infinity()) {
        report.speedsLimited += limitSpeeds(batch, settings.maxSpeed, 0, batch.states.size());
    }
    return report;
}

}  // namespace swept::inline SWEPT_PRECISION
