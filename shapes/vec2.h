#pragma once

#include <cmath>
#include <concepts>

#include "dvec2.h"
#include "real.h"

namespace swept::inline SWEPT_PRECISION {

/// A point or vector in `Real`: everything relative (shape vertices, velocities, offsets from a centre).
struct Vec2 {
    Real x = 0;
    Real y = 0;

    constexpr bool operator==(const Vec2&) const = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
constexpr Vec2 operator*(Real s, Vec2 a) { return {s * a.x, s * a.y}; }
constexpr Vec2 operator*(Vec2 a, Real s) { return s * a; }
constexpr Vec2 operator/(Vec2 a, Real s) { return {a.x / s, a.y / s}; }
constexpr Vec2& operator+=(Vec2& a, Vec2 b) { return a = a + b; }
constexpr Vec2& operator-=(Vec2& a, Vec2 b) { return a = a - b; }
constexpr Vec2& operator*=(Vec2& a, Real s) { return a = s * a; }

constexpr Real dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
constexpr Real cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// ω × r: the velocity of a point at `r` from the centre of a body that turns at `omega` rad/s.
constexpr Vec2 cross(Real omega, Vec2 r) { return {-omega * r.y, omega * r.x}; }
/// `a` turned by +90°.
constexpr Vec2 leftPerp(Vec2 a) { return {-a.y, a.x}; }
/// `a` turned by −90°: the outward normal of a counter-clockwise edge `a`.
constexpr Vec2 rightPerp(Vec2 a) { return {a.y, -a.x}; }

constexpr Real lengthSquared(Vec2 a) { return dot(a, a); }
/// Square root is correctly rounded by IEEE 754, so it may be used on the step path. Overflows above about √max.
inline Real length(Vec2 a) { return std::sqrt(dot(a, a)); }

struct UnitAndLength {
    Vec2 unit;
    Real length;
};

/// Direction and length; works for any finite non-zero vector, as tiny or huge as it may be (scaled by a power of two
/// first, so the direction has full precision); a length beyond the largest `Real` is infinite. A zero vector gives
/// (0, 0) and length 0.
UnitAndLength normalized(Vec2 a);

/// In parentheses, as in all headers that users include: before some of those <windows.h> has made macros of both
/// names.
constexpr Vec2(min)(Vec2 a, Vec2 b) { return {a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y}; }
constexpr Vec2(max)(Vec2 a, Vec2 b) { return {a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y}; }
inline bool isFinite(Real x) { return std::isfinite(x); }
inline bool isFinite(Vec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

constexpr DVec2 toDouble(Vec2 a) { return {static_cast<double>(a.x), static_cast<double>(a.y)}; }
/// Rounds to `Real`: use on differences of positions, never on positions.
constexpr Vec2 toReal(DVec2 a) { return {static_cast<Real>(a.x), static_cast<Real>(a.y)}; }

// A position and a way from it.
constexpr DVec2 operator+(DVec2 position, Vec2 way) { return position + toDouble(way); }
constexpr DVec2 operator-(DVec2 position, Vec2 way) { return position - toDouble(way); }
/// A template, so that `position += {1, 2}` stays in double.
template <std::same_as<Vec2> Way>
constexpr DVec2& operator+=(DVec2& position, Way way) {
    return position = position + way;
}
template <std::same_as<Vec2> Way>
constexpr DVec2& operator-=(DVec2& position, Way way) {
    return position = position - way;
}

}  // namespace swept::inline SWEPT_PRECISION
