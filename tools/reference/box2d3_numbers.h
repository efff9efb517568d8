#pragma once

#include <box2d/box2d.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>

#include <swept/shapes/dvec2.h>

/// Numbers of ours as Box2D 3 has them, and back.

namespace swept {

/// Above any sub-step rate: the engine takes the stiffest spring that it can solve.
constexpr float kStiffHertz = 1e5F;

inline b2Vec2 toPeer(DVec2 v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }
inline b2Pos toPeerPlace(DVec2 v) {
    return {static_cast<decltype(b2Pos::x)>(v.x), static_cast<decltype(b2Pos::y)>(v.y)};
}
/// The engine's own function of the angle is off by up to a milliradian.
inline b2Rot toPeer(double angle) { return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))}; }
template <class Vector>
DVec2 fromPeer(Vector v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y)};
}
inline float orElse(const std::optional<double>& value, float otherwise) {
    return value ? static_cast<float>(*value) : otherwise;
}

/// What the engine refuses quietly is told like what it asserts.
[[noreturn]] inline void refuse(const char* what) {
    std::fputs(what, stderr);
    std::abort();
}

}  // namespace swept
