#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "polygon.h"

namespace swept::inline SWEPT_PRECISION {

/// Pairs of polygons side by side: what is asked about them, and what a kernel answers (manifold_batch.h is what others
/// use). One bit for each pair in the sets.
struct alignas(64) WidePairs {
    static constexpr std::size_t kPairs = 8;
    using Lanes = std::array<Real, kPairs>;

    /// A point of the incident edge, as `ClippedPoint` becomes a `ManifoldPoint`.
    struct Point {
        Lanes x;
        Lanes y;
        Lanes separation;
        Lanes id;
    };

    std::size_t size;  ///< how many are asked about; the others are like the first one, and have no answer
    std::array<const Polygon*, kPairs> a;
    std::array<const Polygon*, kPairs> b;
    std::size_t mostA;  ///< vertices of any A
    std::size_t mostB;
    // Pose of B in the frame of A.
    alignas(64) Lanes c;
    Lanes s;
    Lanes x;
    Lanes y;
    // `ManifoldReach`; `nearest` is at most `points`.
    Lanes points;
    Lanes nearest;
    Lanes radiusA;
    Lanes radiusB;
    Lanes verticesA;  ///< how many
    Lanes verticesB;
    Lanes closedStart;  ///< of a chain segment: 1 where `ClosedEnds` are, else 0
    Lanes closedEnd;

    Lanes normalX;
    Lanes normalY;
    std::array<Point, 2> point;
    Lanes face;              ///< clipped against; of sharp pairs
    Lanes room;              ///< of those that are apart
    std::uint32_t apart;     ///< farther than `nearest`
    std::uint32_t nothing;   ///< of chain segments: there is no point, and no telling for how long
    std::uint32_t ordinary;  ///< B is not shifted farther than `kLargestShift`
    std::uint32_t plain;     ///< there are points, one of them as near as that; nothing else is to be asked
    std::uint32_t ofA;       ///< the face is; or it is none
    std::array<std::uint32_t, 2> isThere;  ///< the point is, and within reach. Neither: it is not what they touch with

    /// Vertices of any polygon.
    std::size_t most() const { return mostA > mostB ? mostA : mostB; }
};

/// Answers what is asked about as many pairs as there are. @pre as `collidesInBatches`
using CollidePairs = void (*)(WidePairs&);

/// For the widest registers that this machine has; null where there are none.
struct PairKernels {
    CollidePairs ofTwo = nullptr;   ///< cores of at most two vertices; not of sharp pairs
    CollidePairs ofFew = nullptr;   ///< of at most `kFewVertices`
    CollidePairs ofMany = nullptr;  ///< any, in proportion to the square of their vertices
};

/// Likewise, of round pairs: for circles as well, and for each of both sides.
struct RoundPairKernels {
    /// By what A has at most, and B: one vertex, two, `kFewVertices`.
    std::array<std::array<CollidePairs, 3>, 3> bySides{};
    CollidePairs ofMany = nullptr;
};
/// Of polygons without radius: the bits of `collideSharp`.
PairKernels sharpPairKernels();
/// Of all others, where cores are apart and nothing is doubtful: the bits of `collideByGjk`. Pairs that are neither
/// `apart` nor `plain` are left to that.
RoundPairKernels roundPairKernels();

/// Of chain segments (A), where what they touch with is the segment itself, or nothing: the bits of `collide`. Pairs
/// that are neither `apart`, nor `plain`, nor `nothing` are left to that.
PairKernels chainPairKernels();

inline constexpr int kFewVertices = 4;
/// Largest shift of B against A: beyond it a double pair is brought to another scale first (rescaled_pair.h), and a
/// float may not hold the points.
inline constexpr Real kLargestShift = std::numeric_limits<Real>::digits == 24 ? Real(0x1p100) : Real(0x1p199);

}  // namespace swept::inline SWEPT_PRECISION
