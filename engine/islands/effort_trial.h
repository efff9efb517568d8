#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "../contacts/contact.h"
#include "../state/body.h"
#include "../state/joint.h"

/// What was solved with too few sub-steps for its error budget is taken back and solved again with more. Errors that
/// come all at once (a blow, a load that arrives, a rope that tightens) cannot be read off the error before them.

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// What a solve changes of a contact.
struct ContactOutcome {
    std::uint32_t contact = 0;  ///< index
    std::array<Real, 2> normalImpulse{};
    std::array<Real, 2> tangentImpulse{};
    std::array<Real, 2> totalImpulse{};
    bool pressed = false;
};

/// State of a class of islands before it is solved. Kept for its capacity.
struct EffortTrial {
    std::vector<BodyMotion> motions;     ///< by body slot; of members and kinematic bodies
    std::vector<std::uint32_t> members;  ///< slots
    std::vector<ContactOutcome> contacts;
    std::vector<Joint> joints;  ///< in the order of `WorldState::tiedJoints`
    std::size_t events = 0;
    std::vector<Contact> held;  ///< of an island with something fast, in the order of `AdvancingIsland::held`
};

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
