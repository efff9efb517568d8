#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "../shapes/aabb.h"

/// What methods share that file proxies by size into lists linked through their slots.

namespace swept::inline SWEPT_PRECISION {

/// Instead of the slot that follows the last one, or precedes the first.
inline constexpr std::uint32_t kEndOfList = (std::numeric_limits<std::uint32_t>::max)();

inline double longerSide(const Aabb& box) {
    return (std::max)(static_cast<double>(box.upper.x) - static_cast<double>(box.lower.x),
                      static_cast<double>(box.upper.y) - static_cast<double>(box.lower.y));
}

}  // namespace swept::inline SWEPT_PRECISION
