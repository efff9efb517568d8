#pragma once

#include "trig.h"
#include "vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// A rotation, stored as cosine and sine of its angle; of unit length up to rounding.
struct Rotation {
    Real c = 1;
    Real s = 0;

    constexpr bool operator==(const Rotation&) const = default;
};

/// From an angle in radians, counter-clockwise positive; each component correct to one rounding of `Real`.
inline Rotation rotationFromAngle(double angle) {
    const SinCos sc = sinCos(angle);
    return {static_cast<Real>(sc.cos), static_cast<Real>(sc.sin)};
}

constexpr Vec2 rotate(Rotation q, Vec2 v) { return {q.c * v.x - q.s * v.y, q.s * v.x + q.c * v.y}; }
constexpr Vec2 unrotate(Rotation q, Vec2 v) { return {q.c * v.x + q.s * v.y, q.c * v.y - q.s * v.x}; }
/// First `b`, then `a`.
constexpr Rotation operator*(Rotation a, Rotation b) { return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s}; }
constexpr Rotation inverse(Rotation q) { return {q.c, -q.s}; }

}  // namespace swept::inline SWEPT_PRECISION
