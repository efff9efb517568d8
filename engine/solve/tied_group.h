#pragma once

#include <span>

#include "../state/step_part.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Bodies that contacts and joints tie together, with these contacts and joints: what one solve is about.
struct TiedGroup {
    SolveDesk& desk;                        ///< where it is solved
    BodyRole role = BodyRole::solved;       ///< of what is moved; others stand by
    Effort effort;                          ///< of those; how they are solved, but for the sub-steps
    std::span<const std::uint32_t> bodies;  ///< slots, those of kinematic bodies that may touch among them
    std::span<Contact> contacts;
    std::span<const TouchingPair> touching{};  ///< of role `solved`: which of these have points
    std::span<const std::uint32_t> joints;     ///< slots
};

inline bool isMember(const Body& body, const TiedGroup& group) {
    return body.role == group.role && body.effort == group.effort;
}

/// Moves the bodies of a group through a part of the step: the sub-stepped solve. Impulses and totals go into the
/// contacts, hits and counts stay at the desk. Contacts of which neither body has the role are skipped. Groups without
/// a body in common, but for static ones, may be solved at the same time.
/// @return false when contacts were to be solved all at once, and at least once were left to iteration
bool solveGroup(WorldState& world, const TiedGroup& group, const StepPart& part);

}  // namespace swept::inline SWEPT_PRECISION
