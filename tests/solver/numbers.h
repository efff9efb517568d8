#pragma once

#include <swept/shapes/vec2.h>

#include <cmath>

namespace swept::test {

inline Real real(double x) { return static_cast<Real>(x); }

/// The vector (x, y) turned by an angle, rad.
inline Vec2 turned(double angle, double x, double y) {
    return {real(std::cos(angle) * x - std::sin(angle) * y), real(std::sin(angle) * x + std::cos(angle) * y)};
}

}  // namespace swept::test
