#pragma once

#include <cstring>

#include <swept/shapes/vec2.h>

/// Equal to the bit, the sign of zero included.

namespace swept {

inline bool sameBits(Real a, Real b) { return std::memcmp(&a, &b, sizeof(Real)) == 0; }
inline bool sameBits(Vec2 a, Vec2 b) { return sameBits(a.x, b.x) && sameBits(a.y, b.y); }

}  // namespace swept
