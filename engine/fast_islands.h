#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <vector>

#include "body.h"
#include "contact.h"
#include "joint.h"

namespace swept::inline SWEPT_PRECISION {

/// A body, contact or joint, and the island that it belongs to.
struct IslandItem {
    std::uint32_t root = 0;
    std::uint32_t order = 0;  ///< of the item in its list: that of waking, of finding, of slots
    std::uint32_t item = 0;   ///< slot, or index of a contact
    auto operator<=>(const IslandItem&) const = default;
};

/// Places of one island in the lists of `FastIslands`.
struct IslandRange {
    std::uint32_t bodies = 0;  ///< the first one
    std::uint32_t bodyCount = 0;
    std::uint32_t contacts = 0;
    std::uint32_t contactCount = 0;
    std::uint32_t joints = 0;
    std::uint32_t jointCount = 0;
    bool isDone = false;  ///< this step: its bodies bounced off each other in flight (clash.h)
};

/// Islands with something fast in them, and what one of them needs while it advances. Kept for its capacity.
struct FastIslands {
    bool any = false;                  ///< this step
    std::vector<std::uint8_t> isFast;  ///< by root
    std::vector<IslandItem> bodies;    ///< sorted, as the others
    std::vector<IslandItem> contacts;
    std::vector<IslandItem> joints;
    std::vector<std::uint32_t> bodySlots;       ///< of `bodies`
    std::vector<std::uint32_t> contactIndices;  ///< of `contacts`
    std::vector<IslandRange> ranges;
    std::vector<std::uint32_t> kinematics;      ///< awake ones
    std::vector<BodyMotion> kinematicsAtStart;  ///< of the step

    // One island at a time.
    std::vector<std::uint32_t> members;  ///< dynamic, slots
    std::vector<std::uint32_t> group;    ///< members, then kinematic bodies
    std::vector<std::uint32_t> jointSlots;
    std::vector<Contact> held;             ///< contacts of the island, and those with ground that it finds on its way
    std::vector<std::uint32_t> sources;    ///< by held contact: its index in the world, or none
    std::vector<std::uint64_t> heldPairs;  ///< of shape slots, sorted
    std::vector<std::uint32_t> found;
    std::vector<BodyMotion> membersAtStart;  ///< of the step
    std::vector<BodyMotion> membersBefore;   ///< before the part that is being tried
    std::vector<Contact> heldBefore;
    std::vector<std::array<Real, 2>> totals;  ///< by held contact: impulses of the parts before
    std::vector<Joint> jointsBefore;
};

}  // namespace swept::inline SWEPT_PRECISION
