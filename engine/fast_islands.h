#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "body.h"
#include "contact.h"
#include "island_items.h"
#include "joint.h"
#include "slide.h"

namespace swept::inline SWEPT_PRECISION {

/// What a solve changes in a contact (first_try.h).
struct TriedContact {
    std::uint32_t contact = 0;  ///< index
    std::uint32_t island = 0;
    std::array<Real, 2> normalImpulse{};
    std::array<Real, 2> tangentImpulse{};
    std::array<Real, 2> totalImpulse{};
    Real approachSpeed = 0;
    bool pressed = false;
    bool pressedOn = false;
};

/// Islands with something fast in them. Kept for its capacity.
struct FastIslands {
    bool any = false;  ///< this step
    std::vector<std::uint32_t>
        numbers;  ///< by body slot: which of these islands it is in, if any; by their lowest members
    std::vector<std::uint8_t> isDone;   ///< by island, this step: its bodies bounced off each other in flight (clash.h)
    std::vector<std::uint8_t> isTried;  ///< by island, this step: solved with all else at first (first_try.h)
    std::vector<double> meets;  ///< by island: fraction of the step at which it met something then; 1: it did not
    std::vector<BodyMotion> triedMotions;     ///< of the members of these islands, before
    std::vector<TriedContact> triedContacts;  ///< and of their contacts
    std::size_t eventsBefore = 0;
    IslandItems bodies;                     ///< slots, in order of waking
    IslandItems contacts;                   ///< indices of their probes
    IslandItems joints;                     ///< slots
    std::vector<std::uint32_t> kinematics;  ///< awake ones
    std::vector<std::uint32_t> waiting;     ///< islands that are still to advance
};

/// What one island needs while it advances. Kept for its capacity.
struct FastIsland {
    std::span<const std::uint32_t> kinematics;  ///< awake ones, of the world
    std::vector<BodyMotion> kinematicsAtStart;  ///< of the step
    std::vector<std::uint32_t> members;         ///< dynamic, slots
    std::vector<std::uint32_t> group;           ///< members, then kinematic bodies
    std::vector<std::uint32_t> jointSlots;
    std::vector<Contact> held;               ///< contacts of the island, and those with ground that it finds on its way
    std::vector<Slide> heldSlides;           ///< of these
    std::vector<std::uint32_t> heldIndices;  ///< as many of the natural numbers as were needed so far
    std::vector<std::uint32_t> sources;      ///< by held contact: its place in the world, or none
    std::vector<std::uint32_t> sourceProbes;  ///< of those that have one, which come first: index of the probe
    std::vector<std::uint64_t> heldPairs;     ///< of shape slots, sorted
    std::vector<std::uint32_t> found;
    std::vector<BodyMotion> membersAtStart;  ///< of the step
    std::vector<BodyMotion> membersBefore;   ///< before the part that is being tried
    std::vector<Contact> heldBefore;
    std::vector<std::array<Real, 2>> totals;  ///< by held contact: impulses of the parts before
    std::vector<Joint> jointsBefore;
    std::vector<std::uint32_t> nextGroundContact;  ///< by held contact: see dropGhosts
};

}  // namespace swept::inline SWEPT_PRECISION
