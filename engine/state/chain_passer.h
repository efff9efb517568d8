#pragma once

#include <compare>
#include <cstdint>

#include "../../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// A shape that comes through a chain segment from its back (chain_passage.h); slots.
struct ChainPasser {
    std::uint32_t segment = 0;
    std::uint32_t shape = 0;
    auto operator<=>(const ChainPasser&) const = default;
};

/// One in which it is as a step ends, and the centre of its body, metres: what is put elsewhere is not in it any more.
struct ChainCrossing {
    ChainPasser passer;
    DVec2 center{};
};

}  // namespace swept::inline SWEPT_PRECISION
