#pragma once

#include <array>

#include "../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// The three coordinates in which a body moves: x, y, angle. Always double: stiff rows between masses of 1 : 10⁶ need
/// it.
using Block3 = std::array<double, 3>;
/// Row by row.
using Block33 = std::array<double, 9>;

}  // namespace swept::inline SWEPT_PRECISION
