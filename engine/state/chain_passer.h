#pragma once

#include <compare>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// A shape that comes through a chain segment from its back (chain_passage.h); slots.
struct ChainPasser {
    std::uint32_t segment = 0;
    std::uint32_t shape = 0;
    auto operator<=>(const ChainPasser&) const = default;
};

}  // namespace swept::inline SWEPT_PRECISION
