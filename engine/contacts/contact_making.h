#pragma once

#include "../state/world_state.h"

/// Contacts as they are made of two shapes, and the places that they have in memory.

namespace swept::inline SWEPT_PRECISION {

/// A contact of two shapes, still without manifold; which of them is its A is decided here.
Contact contactOf(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB);
/// Friction and restitution of a contact, by its shapes.
void mixSurfaces(const WorldState& world, Contact& contact);
/// The same with the speed of belts, which contacts do not keep.
MixedSurface surfaceOf(const WorldState& world, const Contact& contact);
/// Pairs that are looked up in the table of pairs ahead of time: each is a cache line of its own.
inline constexpr std::size_t kLookedUpAhead = 8;

/// The shape that has a proxy, slot.
inline std::uint32_t shapeOf(const WorldState& world, ProxyId proxy) {
    return world.proxyShapes[static_cast<std::size_t>(proxy)];
}

/// Makes a contact of two shapes, with its probe: the last of all.
void makeContact(WorldState& world, std::uint32_t a, std::uint32_t b);
/// Likewise of all pairs, in their order.
void makeContacts(WorldState& world, std::span<const ContactPair> pairs);
/// Moves contacts together when there are many gaps between them. Before anything refers to their places.
void closeGaps(WorldState& world);
/// So that the broadphase may find the pair anew.
void dropPair(WorldState& world, const ContactPair& pair);
void dropPairs(WorldState& world, std::span<const ContactPair> pairs);

}  // namespace swept::inline SWEPT_PRECISION
