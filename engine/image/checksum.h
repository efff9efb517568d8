#pragma once

#include <cstdint>
#include <span>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// Of some bytes, 64 bits. Whatever of them is changed within eight that stand together (from a multiple of eight on)
/// changes it; other damage does but for one time in 2⁶⁴. The same on every machine.
std::uint64_t checksumOf(std::span<const std::uint8_t> bytes);

}  // namespace swept::inline SWEPT_PRECISION
