#pragma once

#include <swept/shapes/vec2.h>

namespace swept::bench {

/// In the names of what is measured once per precision. (A name of each file: programs have both.)
constexpr auto kPrecision = sizeof(Real) == sizeof(float) ? "f32" : "f64";

}  // namespace swept::bench
