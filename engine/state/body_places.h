#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// A body by where it is.
struct BodyPlace {
    std::uint64_t key = 0;
    std::uint32_t slot = 0;
};

/// Scratch of `orderByPlace`, kept for its capacity.
struct BodyPlaces {
    std::vector<BodyPlace> order;
    std::vector<BodyPlace> spare;
};

}  // namespace swept::inline SWEPT_PRECISION
