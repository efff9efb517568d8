#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "../containers/boxed_items.h"
#include "chain_passer.h"
#include "contact.h"
#include "deck_contacts.h"
#include "joint.h"
#include "lent_energy_state.h"
#include "slide.h"
#include "solve_desk.h"
#include "solve_outcome.h"

namespace swept::inline SWEPT_PRECISION {

/// What one island needs while it advances (island_advance.h). Kept for its capacity.
struct AdvancingIsland {
    std::vector<std::uint32_t> members;  ///< dynamic, slots
    std::vector<std::uint32_t> group;    ///< members, then kinematic bodies that it came near
    std::vector<std::uint32_t> jointSlots;
    std::vector<Contact> contacts;            ///< of the island, and those with ground that it finds on its way
    std::vector<Slide> slides;                ///< of these
    std::vector<std::uint32_t> indices;       ///< as many of the natural numbers as were needed so far
    std::vector<Manifold> pointsBefore;       ///< by contact: the last points that it had before this part, if any
    std::vector<std::uint32_t> sources;       ///< by contact: its place in the world, or none
    std::vector<std::uint32_t> sourceProbes;  ///< of those that have one, which come first: index of the probe
    std::vector<std::uint64_t> pairs;         ///< of shape slots, sorted
    std::vector<std::uint32_t> found;
    std::vector<BoxedItem> boxed;             ///< shapes of members, by slot: scratch, as is the next one
    std::vector<std::uint64_t> metPairs;      ///< of shape slots
    double usualSubStep = 0;                  ///< of the world, s
    double subStep = 0;                       ///< that the impulses of the contacts belong to, s
    std::vector<BodyOutcome> membersAtStart;  ///< of the step
    std::vector<BodyOutcome> membersBefore;   ///< before the part that is being tried
    std::vector<Contact> contactsBefore;      ///< likewise, but for the first part
    std::vector<std::array<Real, 2>> totals;  ///< by contact: impulses of the parts before
    std::vector<Joint> jointsBefore;
    LentEnergy lentAtStart;                        ///< of the step
    std::vector<std::uint32_t> nextGroundContact;  ///< by contact: see dropGhosts
    DeckContacts deckContacts;                     ///< scratch of `dropGhostsOfDecks`
    std::vector<ChainPasser> crossing;             ///< what its members are in at the start of the part, in order
    std::vector<std::uint64_t> chainContacts;      ///< scratch of `letThrough`
};

/// Where islands are solved that advance, one after the other.
struct IslandDesk : SolveDesk {
    AdvancingIsland island;      ///< the present one
    std::vector<Contact> found;  ///< contacts that they found on their way, and that pressed
};

}  // namespace swept::inline SWEPT_PRECISION
