#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"
#include "../../solver/graph/island_finder.h"
#include "touching.h"

namespace swept::inline SWEPT_PRECISION {

/// Fast bodies that fly along beside each other pass each other, as far as their motion at the start of the step tells,
/// and so nothing holds them apart. But when the first of a falling heap strikes the ground, the next one runs into it
/// within the same step, and so on through the heap: without contacts each goes into the one before it by all of its
/// way in a step. So what passes by within `kHemRatio` of the extent is held apart as soon as anything in the group
/// that hangs together by such pairs has a contact in this step. What falls freely pays for the list alone.
///
/// Most of these pairs are told from bounds of their distance, and other bounds from what was found by other ways (in a
/// batch, one by one) tell others. So bounds only say which groups may be struck, and what may be in them: the
/// manifolds of those say what is, whatever the bounds were.
struct HemmedPairs {
    std::vector<TouchingPair> passing;   ///< of this step: have points, and pass each other
    std::vector<std::uint32_t> unasked;  ///< scratch: places of probes that are told to pass each other from bounds
    IslandFinder groups;                 ///< scratch: bodies that contacts or passing pairs tie together
    std::vector<std::uint8_t> isStruck;  ///< scratch, by root: something in the group has a contact
};

}  // namespace swept::inline SWEPT_PRECISION
