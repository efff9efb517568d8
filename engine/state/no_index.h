#pragma once

#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// Of what has no place, slot or number in a list.
inline constexpr std::uint32_t kNoIndex = 0xFFFFFFFFu;

}  // namespace swept::inline SWEPT_PRECISION
