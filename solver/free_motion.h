#pragma once

#include <array>
#include <vector>

#include "solver_batch.h"

/// How bodies of a solve move between what constraints do to them.

namespace swept::inline SWEPT_PRECISION {

/// The first half of a state: as many numbers as a register of 16 or 32 bytes holds, of which the last one is no speed.
using Speeds = std::array<Real, 4>;

/// Of some slots, what can be moved: the others move as they are told.
/// @param maxSpeed  m/s
/// @return how many speeds were cut
int limitSpeeds(SolverBatch& batch, Real maxSpeed, std::size_t begin, std::size_t end);

/// Drives of a whole sub-step, or of half a one, of some slots. @return how many speeds were cut
int integrateVelocities(SolverBatch& batch, Real maxSpeed, std::size_t begin, std::size_t end);

/// Drives of a whole sub-step, and on top of them what constraints did to the bodies in the sub-step before, unless
/// this is the first.
/// @param free  by slot: speeds without these: before, and then now
int integrateAndRepeat(SolverBatch& batch, Real maxSpeed, bool isFirst, RawVector<Speeds>& free, std::size_t begin,
                       std::size_t end);

}  // namespace swept::inline SWEPT_PRECISION
