#pragma once

#include <cstddef>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// As the stage of contacts begins: parks what came to rest, once that is an eighth of what is awake: the others have
/// to move up.
void parkContacts(WorldState& world);
/// Brings back the contacts of what woke, with impulses of the sub-steps that there are now: a look at those, and at no
/// others. @return how many, at the end of the probes
/// @pre pairs are closed up (`closeUpPairs`): places are other ones then
std::size_t unparkContacts(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
