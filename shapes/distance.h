#pragma once

#include <array>
#include <cstdint>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// The simplex on which a distance query ended: vertex indices of both shapes. Hand it to the next query of the same
/// pair to start there. A default one starts cold. Indices that do not fit the shapes are ignored.
struct SimplexCache {
    std::uint8_t count = 0;  ///< 0 … 3
    std::array<std::uint8_t, 3> indexA{};
    std::array<std::uint8_t, 3> indexB{};
};

struct Distance {
    /// Signed, metres, radii included: positive apart, 0 touching, negative the penetration depth (the length of the
    /// smallest translation that separates the shapes).
    Real distance = 0;
    /// Unit vector from A to B, frame of A: moving B by it increases the distance one for one.
    Vec2 normal;
    Vec2 pointA;            ///< witness on the rounded surface of A, frame of A
    Vec2 pointB;            ///< witness on the rounded surface of B, frame of A; pointB − pointA = distance·normal
    Real coreDistance = 0;  ///< the same without radii: ≥ 0, or negative when the cores overlap
    int iterations = 0;     ///< of GJK, at least 1
};

/// Distance of two convex polygons with radii, by GJK (Gilbert, Johnson, Keerthi 1988) with Ericson-style sub-distance
/// solves on the features, and by separating axes once the cores overlap. No absolute tolerance: all guards compare
/// like with like, so scaling all lengths by a power of two scales the answer and nothing else.
/// @param bInA   pose of B in the frame of A.
/// @param cache  read and updated when not null.
/// Bounded by `kMaxGjkIterations`; distance error at most 8 eps × (sizes + distance) for the given pose, where the size
/// of a shape is the distance of its farthest point from the origin of its frame.
Distance distance(const Polygon& a, const Polygon& b, const Transform& bInA, SimplexCache* cache = nullptr);

/// Each iteration strictly lowers the distance or stops, over at most 8·8 support pairs; typical runs take 2 to 4.
inline constexpr int kMaxGjkIterations = 64;

}  // namespace swept::inline SWEPT_PRECISION
