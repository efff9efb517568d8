#pragma once

#include <cmath>

namespace swept {

/// A point or vector in double, in both builds: world positions, sweeps, scenes. Metres unless said otherwise.
struct DVec2 {
    double x = 0;
    double y = 0;

    constexpr bool operator==(const DVec2&) const = default;
};

constexpr DVec2 operator+(DVec2 a, DVec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr DVec2 operator-(DVec2 a, DVec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr DVec2 operator-(DVec2 a) { return {-a.x, -a.y}; }
constexpr DVec2 operator*(double s, DVec2 a) { return {s * a.x, s * a.y}; }
constexpr DVec2 operator*(DVec2 a, double s) { return s * a; }
constexpr DVec2 operator/(DVec2 a, double s) { return {a.x / s, a.y / s}; }
constexpr DVec2& operator+=(DVec2& a, DVec2 b) { return a = a + b; }
constexpr DVec2& operator-=(DVec2& a, DVec2 b) { return a = a - b; }
constexpr DVec2& operator*=(DVec2& a, double s) { return a = s * a; }
constexpr double dot(DVec2 a, DVec2 b) { return a.x * b.x + a.y * b.y; }
constexpr double cross(DVec2 a, DVec2 b) { return a.x * b.y - a.y * b.x; }
/// `a` turned by +90°.
constexpr DVec2 leftPerp(DVec2 a) { return {-a.y, a.x}; }
constexpr double lengthSquared(DVec2 a) { return dot(a, a); }
inline double length(DVec2 a) { return std::sqrt(dot(a, a)); }
inline bool isFinite(DVec2 a) { return std::isfinite(a.x) && std::isfinite(a.y); }

}  // namespace swept
