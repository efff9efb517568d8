#pragma once

#include <array>
#include <cstddef>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// The three coordinates in which a body moves: x, y, angle. Always double: stiff rows between masses of 1 : 10⁶ need
/// it.
using Block3 = std::array<double, 3>;
/// Row by row.
using Block33 = std::array<double, 9>;

/// block += factor · a · bᵀ
inline void addOuter(Block33& block, double factor, const Block3& a, const Block3& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double scaled = factor * a[i];
        for (std::size_t k = 0; k < 3; ++k) { block[3 * i + k] += scaled * b[k]; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
