#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What a body may come to move in a step since it is struck (stirred.h).
struct Blow {
    Real length = 0;  ///< metres; 0: none
    Real mass = 0;    ///< kg that move so: of the striker, and of all that it went through
};

/// A body that is stirred.
struct Stirred {
    std::uint32_t body = 0;  ///< slot
    Blow blow{};
};

struct Stirs {
    std::vector<Stirred> bodies;  ///< of this step
    // Scratch of `findStirred`:
    std::vector<std::uint32_t> strikers;  ///< slots of what moves enough to strike anything
    std::vector<std::uint8_t> moves;      ///< by body slot: whether it does; zeros between steps
    std::vector<std::uint32_t> met;       ///< slots of shapes that one of them comes to
    std::vector<std::uint32_t> noted;     ///< slots of what has a blow
    std::vector<Blow> blows;              ///< by body slot; none between steps
};

}  // namespace swept::inline SWEPT_PRECISION
