#pragma once

#include <cstdint>
#include <vector>

#include "parked_pairs.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Of what sub-steps the impulses of a parked contact are: there may be others when it comes back.
struct ParkedImpulses {
    double dt = 0;  ///< of the step, s; 0: there was none yet, and they are zero
    int subSteps = 1;
    bool wasStill = false;  ///< then they were no blow
};

/// The probes of contacts of which neither body is awake, and candidates likewise, where no loop of a step gets to.
/// Those of bodies that wake come back, to the end of the others.
struct ParkedContacts {
    ParkedPairs<ContactProbe> probes;
    ParkedPairs<ContactPair> candidates;
    std::vector<ParkedImpulses> impulses;  ///< by place of a probe
    std::uint32_t touching = 0;            ///< parked contacts with points
    std::uint32_t rested = 0;              ///< bodies that came to rest since contacts were parked last
    std::vector<std::uint32_t> woken;      ///< slots of bodies that woke, whose contacts may be parked
    // Scratch.
    std::vector<std::uint8_t> isUp;  ///< by body slot: awake
    std::vector<std::uint32_t> places;
};

/// As the stage of contacts begins: parks what came to rest, once that is an eighth of what is awake: the others have
/// to move up.
void parkContacts(WorldState& world);
/// Brings back the contacts of what woke, with impulses of the sub-steps that there are now: a look at those, and at no
/// others. @return how many, at the end of the probes
/// @pre pairs are closed up (`closeUpPairs`): places are other ones then
std::size_t unparkContacts(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
