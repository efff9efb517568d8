#pragma once

#include <cstdint>
#include <vector>

#include "no_index.h"

namespace swept::inline SWEPT_PRECISION {

/// A contact as that of a shape with a piece of a deck (contacts/decks.h).
struct DeckContact {
    std::uint32_t own = 0;      ///< slot of the shape
    std::uint32_t deck = 0;     ///< of the body
    std::uint32_t contact = 0;  ///< index
    std::uint32_t place = 0;    ///< in the list that it comes from
    bool deckIsA = false;
    bool isTaken = false;
    std::uint8_t rank = 0;          ///< `ghostRank`
    std::uint32_t next = kNoIndex;  ///< place of the next one of the same shape and deck, if not of others
};

/// Scratch of a step.
struct DeckContacts {
    std::vector<std::uint32_t> candidates;  ///< contacts of the world that may be such ones
    std::vector<std::uint32_t> probes;      ///< theirs
    std::vector<std::uint32_t> changed;     ///< places of those that lost points, or have other ones
    std::vector<DeckContact> contacts;
    std::vector<std::uint8_t> counts;   ///< by a hash of shape and deck: none, one, or two and more
    std::vector<std::uint32_t> lastOf;  ///< likewise: place of the last one so far
    std::vector<DeckContact> group;     ///< of one shape with one deck
};

}  // namespace swept::inline SWEPT_PRECISION
