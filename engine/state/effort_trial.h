#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "contact.h"
#include "joint.h"
#include "lent_energy_state.h"
#include "solve_outcome.h"

namespace swept::inline SWEPT_PRECISION {

/// What joints of a chain may give back.
struct ChainLoan {
    std::uint32_t chain = 0;  ///< in `JointChains::list`
    LentEnergy lent{};
};

/// State of a class of islands before it is solved. Kept for its capacity.
struct EffortTrial {
    std::vector<BodyOutcome> bodies;     ///< by body slot; of members, and the motions of kinematic ones
    std::vector<std::uint32_t> members;  ///< slots
    std::vector<ContactOutcome> contacts;
    std::vector<Joint> joints;  ///< in the order of `WorldState::tiedJoints`
    std::vector<ChainLoan> loans;
    std::size_t events = 0;
    /// Of an island with something fast, in the order of `AdvancingIsland::contacts`.
    std::vector<Contact> fastContacts;
};

}  // namespace swept::inline SWEPT_PRECISION
