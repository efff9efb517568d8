#pragma once

#include <cstddef>

namespace swept {

/// Bytes that processors hand to each other at once; on other machines than most, sharing is only slower.
inline constexpr std::size_t kCacheLine = 64;

}  // namespace swept
