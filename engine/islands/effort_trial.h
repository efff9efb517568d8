#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "../state/effort.h"

/// What was solved with too few sub-steps for its error budget is taken back and solved again with more. Errors that
/// come all at once (a blow, a load that arrives, a rope that tightens) cannot be read off the error before them.

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Before the islands of an effort are solved. @pre `WorldState::tiedJoints` are theirs
void rememberClass(WorldState& world, Effort effort);

/// After they were: those that went beyond a budget, where more sub-steps may mend that, are as they were before, and
/// have an effort that comes later in `WorldState::efforts`. A bounded number of times in a step.
/// @param place  of the effort there; what comes later has more sub-steps
void takeBackMissed(WorldState& world, std::size_t place, double dt);

/// After they were: all are as they were before, and have that effort, which comes later.
void takeBackClass(WorldState& world, std::size_t place, Effort next);

/// After an island with something fast advanced from impact to impact: whether its joints went beyond their budget, and
/// more sub-steps, which its members then have, may mend that. (How deep it gets depends on where its parts end.)
/// @param joints  of the island, slots; not empty
bool raiseMissedJoints(WorldState& world, std::span<const std::uint32_t> members, std::span<const std::uint32_t> joints,
                       double dt);

}  // namespace swept::inline SWEPT_PRECISION
