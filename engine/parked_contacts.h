#pragma once

#include <cstdint>
#include <vector>

#include "contact.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// The probes of contacts of which neither body is awake stand behind the others, where no loop of a step gets to;
/// candidates likewise, in a list of their own. Those of bodies that wake come back, to the end of the others.
struct ParkedContacts {
    std::uint32_t rested = 0;    ///< bodies that came to rest since contacts were parked last
    bool woke = false;           ///< bodies woke, whose contacts may be parked
    std::uint32_t touching = 0;  ///< parked contacts with points
    std::vector<ContactPair> candidates;
    // Scratch.
    std::vector<std::uint8_t> isUp;  ///< by body slot: awake
    std::vector<ContactProbe> probes;
};

/// As the stage of contacts begins: parks what came to rest, once that is an eighth of what is awake: the others have
/// to move up.
void parkContacts(WorldState& world);
/// Brings back the contacts of what woke. @return how many, at the end of those that are not parked
std::size_t unparkContacts(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
