#pragma once

#include <cstdint>
#include <vector>

#include "../containers/island_items.h"
#include "clash_work.h"
#include "contact.h"
#include "joint.h"
#include "lent_energy_state.h"
#include "moving_ground.h"
#include "solve_outcome.h"

namespace swept::inline SWEPT_PRECISION {

/// A contact of an island that is solved with all else at first (first_try.h).
struct TriedContact {
    std::uint32_t island = 0;
    ContactOutcome before{};
};

/// Of a hinge, all that such a solve may change and the next one begins with.
struct TriedHinge {
    HingeMemory hinge{};
    JointLoad restLoad{};
};

/// Where an island keeps what such a solve changes: index of its first member, hinge and other joint there.
struct TriedPlace {
    std::size_t body = 0;
    std::size_t hinge = 0;
    std::size_t joint = 0;  ///< another one
};

/// Islands with something fast in them. Kept for its capacity.
struct FastIslands {
    bool any = false;                    ///< this step
    std::vector<std::uint32_t> members;  ///< by root: bodies of any island, where some tied one is fast
    std::vector<std::uint32_t>
        numbers;  ///< by body slot: which of these islands it is in, if any; by their lowest members
    std::vector<std::uint32_t> roots;   ///< the lowest members of these islands, ascending
    std::vector<ClashEnd> clashes;      ///< by island, this step
    bool anyDissolved = false;          ///< of these
    std::vector<std::uint8_t> isTried;  ///< by island, this step: solved with all else at first (first_try.h)
    std::vector<double> meets;  ///< by island: fraction of the step at which it met something then; 1: it did not
    std::vector<TriedPlace> triedPlaces;      ///< by island, likewise: in the last three of these
    std::vector<TriedContact> triedContacts;  ///< of all of them, before
    std::vector<BodyOutcome> triedBodies;     ///< their members
    std::vector<TriedHinge> triedHinges;      ///< and their joints
    std::vector<LentEnergy> triedLoans;       ///< by island: that of its chain
    std::vector<Joint> triedJoints;           ///< those that are no hinges
    std::size_t eventsBefore = 0;
    IslandItems bodies;                                             ///< slots, in order of waking
    IslandItems contacts;                                           ///< indices of their probes
    std::vector<std::vector<IslandItems::Added>> contactsOfBlocks;  ///< scratch: likewise, by block of probes
    IslandItems joints;                                             ///< slots
    MovingGround ground;
    std::vector<std::uint32_t> waiting;  ///< islands that are still to advance
    std::vector<Contact> found;          ///< scratch: what they found on their way, of all desks
};

}  // namespace swept::inline SWEPT_PRECISION
