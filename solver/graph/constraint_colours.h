#pragma once

#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// Colours of the constraint graph. Two constraints of one colour share no movable body, so a colour can be solved wide
/// or by many threads, in any order, with the same bits. The last colour is the overflow: solved one after the other.
inline constexpr int kColourCount = 64;
inline constexpr int kOverflowColour = kColourCount - 1;
/// Constraints against the fixed world take colours from here on, so that they are solved last: ground has the last
/// word.
inline constexpr int kFirstFixedColour = 48;

/// A range of one colour within a kind's array.
struct ColourRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

}  // namespace swept::inline SWEPT_PRECISION
