#pragma once

#include <span>

#include "../state/step_part.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Islands of more members are moved as if nothing in them were fast, and what strikes something on its way is held
/// there: too many bodies for going through the step more than once, which profile `fast` does less often.
std::size_t mostTogether(const WorldSettings& settings);

/// Advances one island through the step, all of it together from impact to impact: a part of the step is solved, its
/// fast members are swept over it, and where one of them would meet something static or kinematic that no contact holds
/// it off yet, the part is taken back and made as long as it takes to get there; then the contact is known, and takes
/// part in the next solve. Parts get no shorter than a certain share of the step: in those a member is held at its
/// impact on its own, and what it loses enters the ledger. A body on its own flies (flight.h) when it would meet
/// something.
/// Islands may advance at the same time, each at a desk of its own, while no kinematic body is awake.
/// @pre members, joints and contacts of the island are in `IslandDesk::island`; and `listMovingGround`
/// @param met  fraction of the step at which it meets something when all of that is one part, as was tried already; 1:
/// it was not
void advanceIsland(WorldState& world, IslandDesk& desk, double dt, FlightScratch& scratch, double met = 1);

/// Fraction of a part of the step, which was solved, at which the first member meets something; 1: none does. What a
/// member is sunk into does not count: that holds it alone (`holdSunk`), and does not hold up its island again and
/// again.
double firstImpactOf(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part,
                     FlightScratch& scratch);
/// Of a part of the step that was solved: members that are sunk into something get no deeper.
void holdSunk(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part, FlightScratch& scratch);

/// Notes what fast members cross as the part ends (chain_crossing.h), if a search met the back of a chain.
void noteCrossingsOf(const WorldState& world, std::span<const std::uint32_t> members, const StepPart& part,
                     FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
