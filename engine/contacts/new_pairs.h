#pragma once

#include "../state/world_state.h"

/// Pairs of shapes whose boxes began to overlap: contacts, or candidates for that.

namespace swept::inline SWEPT_PRECISION {

/// What two shapes are to each other.
NewPair newPairOf(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB);
/// Those that the stage of pairs found (`WorldState::newPairKinds`) become contacts, or candidates for that, in their
/// order; what two of them met where nothing moves is awake after the second call. (Stage of contacts: beside the first
/// one others may look at bodies.)
void addPairs(WorldState& world);
void releaseMet(WorldState& world);
/// @return false when the two may not touch, or have a contact already
bool addContact(WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB);

}  // namespace swept::inline SWEPT_PRECISION
