#pragma once

#include <cstdint>

#include "../shapes/real.h"

/// What the files of the direct solver share.

namespace swept::inline SWEPT_PRECISION {

inline constexpr std::uint32_t kNoNode = ~std::uint32_t{0};

/// What of a contact point is in the matrix, as one number.
constexpr std::uint8_t holdsOf(bool presses, bool sticks) {
    return static_cast<std::uint8_t>((presses ? 1 : 0) + (sticks ? 2 : 0));
}

}  // namespace swept::inline SWEPT_PRECISION
