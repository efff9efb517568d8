#pragma once

#include "../state/world_state.h"

/// What a shape is in the broadphase. Shapes of bodies that are enabled have a proxy; its kind is the shape's.

namespace swept::inline SWEPT_PRECISION {

/// A proxy for a shape that has no slot yet, or is about to get one. It refuses what the broadphase does.
/// @pre its body is enabled
Result<ProxyId> makeProxy(WorldState& world, const Shape& shape);
/// Whose it is.
void rememberProxy(WorldState& world, ProxyId proxy, std::uint32_t shape);
/// Counts a shape, as it is defined, among those of which there may be none, or no longer: before it changes or goes.
/// @pre there is room for one more of `WorldState::sensors`, if it is one
void countTraits(WorldState& world, std::uint32_t shape);
void discountTraits(WorldState& world, std::uint32_t shape);
/// Both at once, for a shape that has a slot.
Status addProxy(WorldState& world, std::uint32_t shape);
/// No effect on those that have none. @pre it has no contacts
void removeProxy(WorldState& world, std::uint32_t shape);
/// Takes all that others know of a shape, and its proxy. @pre it has no contacts
void emptyShapeSlot(WorldState& world, std::uint32_t shape);
/// Frees the slot of a shape, likewise. @pre it has no contacts, and its body lists it no longer, or goes as well
void removeShapeSlot(WorldState& world, std::uint32_t shape);
/// Shapes that may meet other ones than before (their body's type, sensors, filters) have new proxies, whose pairs are
/// all found anew. @pre they have no contacts
void renewKinds(WorldState& world, std::span<const std::uint32_t> shapes);

}  // namespace swept::inline SWEPT_PRECISION
