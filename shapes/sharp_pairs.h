#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Pairs of polygons without radius side by side: what is asked about them, and what a kernel answers
/// (manifold_batch.h is what others use). One bit for each pair in the sets.
struct alignas(64) SharpPairs {
    static constexpr std::size_t kPairs = 8;
    using Lanes = std::array<Real, kPairs>;

    /// A point of the incident edge, as `ClippedPoint` becomes a `ManifoldPoint`.
    struct Point {
        Lanes x;
        Lanes y;
        Lanes separation;
        Lanes id;
    };

    std::array<const Polygon*, kPairs> a;
    std::array<const Polygon*, kPairs> b;
    std::size_t vertices;  ///< of none of them more
    // Pose of B in the frame of A.
    alignas(64) Lanes c;
    Lanes s;
    Lanes x;
    Lanes y;
    // `ManifoldReach`; `nearest` is at most `points`.
    Lanes points;
    Lanes nearest;

    Lanes normalX;
    Lanes normalY;
    std::array<Point, 2> point;
    Lanes face;              ///< clipped against
    Lanes room;              ///< of those that are apart
    std::uint32_t apart;     ///< farther than `nearest`
    std::uint32_t ordinary;  ///< B is not shifted farther than `kLargestShift`
    std::uint32_t plain;     ///< there are points, one of them as near as that; nothing else is to be asked
    std::uint32_t ofA;       ///< the face is
    std::array<std::uint32_t, 2> isThere;  ///< the point is, and within reach. Neither: it is not what they touch with
};

/// Answers what is asked about all pairs: the bits of `collideSharp`. @pre as `collidesInBatches`
using CollideSharpPairs = void (*)(SharpPairs&);

/// For the widest registers that this machine has; null where there are none.
struct SharpPairKernels {
    CollideSharpPairs ofFew = nullptr;   ///< polygons of at most `kFewVertices`
    CollideSharpPairs ofMany = nullptr;  ///< any, in proportion to the square of their vertices
};
SharpPairKernels sharpPairKernels();

inline constexpr int kFewVertices = 4;
/// Largest shift of B against A: beyond it a double pair is brought to another scale first (rescaled_pair.h), and a
/// float may not hold the points.
inline constexpr Real kLargestShift = std::numeric_limits<Real>::digits == 24 ? Real(0x1p100) : Real(0x1p199);

}  // namespace swept::inline SWEPT_PRECISION
