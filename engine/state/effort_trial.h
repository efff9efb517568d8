#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "body.h"
#include "contact.h"
#include "joint.h"
#include "lent_energy_state.h"

namespace swept::inline SWEPT_PRECISION {

/// What a solve changes of a contact.
struct ContactOutcome {
    std::uint32_t contact = 0;  ///< index
    std::array<Real, 2> normalImpulse{};
    std::array<Real, 2> tangentImpulse{};
    std::array<Real, 2> totalImpulse{};
    bool pressed = false;
};

/// What joints of a chain may give back.
struct ChainLoan {
    std::uint32_t chain = 0;  ///< in `JointChains::list`
    LentEnergy lent{};
};

/// State of a class of islands before it is solved. Kept for its capacity.
struct EffortTrial {
    std::vector<BodyMotion> motions;     ///< by body slot; of members and kinematic bodies
    std::vector<std::uint32_t> members;  ///< slots
    std::vector<ContactOutcome> contacts;
    std::vector<Joint> joints;  ///< in the order of `WorldState::tiedJoints`
    std::vector<ChainLoan> loans;
    std::size_t events = 0;
    std::vector<Contact> held;  ///< of an island with something fast, in the order of `AdvancingIsland::held`
};

}  // namespace swept::inline SWEPT_PRECISION
