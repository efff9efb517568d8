#pragma once

#include <cstdint>
#include <vector>

#include "contact.h"
#include "parked_pairs.h"

namespace swept::inline SWEPT_PRECISION {

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

}  // namespace swept::inline SWEPT_PRECISION
