#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What the order of events is told by, mostly.
struct EventPlace {
    std::uint64_t key = 0;    ///< slots of its shapes, the lower above the other; or its fraction, as bits
    std::uint32_t index = 0;  ///< in `WorldState::contactEvents`
};

/// Who touches a chain. Of a sensor (A) which of the two slots it has: that may change.
enum class TouchKind : std::uint8_t { ofSolid, ofLowerSensor, ofHigherSensor };

/// A touch with a segment of a chain.
struct ChainTouch {
    std::uint64_t key = 0;  ///< slots of the shapes, of the chain its first segment: that of an `EventPlace`
    TouchKind kind = TouchKind::ofSolid;
};

/// Scratch of `sortEvents`, kept for its capacity.
struct EventPlaces {
    std::vector<EventPlace> ofChains;  ///< begins and ends
    std::vector<EventPlace> hitsOfChains;
    std::vector<EventPlace> atStart;       ///< of the step: all others of fraction 0
    std::vector<EventPlace> later;         ///< by fraction
    std::vector<EventPlace> spare;         ///< of `sortByKeys`
    std::vector<ChainTouch> chainTouches;  ///< that events ask for, one per segment
    std::vector<ChainTouch> spareTouches;  ///< of `sortByKeys`
    std::vector<std::uint8_t> isNamed;     ///< by slot of a shape: it begins or ends to touch a chain, or is one
};

}  // namespace swept::inline SWEPT_PRECISION
