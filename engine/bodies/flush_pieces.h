#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../state/world_state.h"

/// Which shapes of a dynamic body stand side by side with faces in one plane, as the planks of a raft: what passes over
/// the seams between them may have to be told of them (contacts/decks.h).

namespace swept::inline SWEPT_PRECISION {

/// Marks them. @param first  of those that the body got, in its list
/// @return which of the others are marked now, and were not before
std::vector<std::uint32_t> markFlushPieces(WorldState& world, std::uint32_t body, std::size_t first);

}  // namespace swept::inline SWEPT_PRECISION
