#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

/// Ghosts on decks: a dynamic body may be made of flush pieces as well, as a raft, the roof of a train or a ship of
/// blocks is. What lies, slides or rolls on it meets their seams as those of ground (ghosts.h), and so does ground that
/// such a body slides over. So a contact yields to another one of the same shape with another piece of the same body.

namespace swept::inline SWEPT_PRECISION {

/// Drops the ghosts among contacts with pieces, or turns them to the faces that are there.
/// @param renewed  indices of contacts whose manifold is new, among others
/// @return places in `renewed` of those that were dropped or turned, valid until the next call
std::span<const std::uint32_t> dropGhostsOfDecks(const WorldState& world, std::span<Contact> contacts,
                                                 std::span<const std::uint32_t> renewed, DeckContacts& scratch);
/// Of the contacts of the world that are near, whose probes do not tell what they have then.
void dropGhostsOfDecks(WorldState& world);

/// What tells that a contact is one with a piece. (It is asked before the shapes are.)
void notePieces(const WorldState& world, Contact& contact);
/// Of contacts with shapes that are pieces now, and were not when these began.
void notePiecesOf(WorldState& world, std::span<const std::uint32_t> shapes);

}  // namespace swept::inline SWEPT_PRECISION
