#pragma once

#include <array>

#include "core_axis.h"
#include "distance.h"

namespace swept::inline SWEPT_PRECISION {

/// A vertex of each shape: together a vertex of the Minkowski difference B − A.
struct SupportPair {
    int a;
    int b;
};

enum class GjkOutcome : std::uint8_t {
    apart,     ///< the distance is `distance` up to rounding: a separating direction proves it
    touching,  ///< the cores overlap, or their distance is below what double resolves at these coordinates
    stalled,   ///< rounding stopped the progress before the proof; the simplex is only a guess
};

/// Where a run of GJK on the cores (without radii) ended. The simplex has 1 or 2 pairs when apart, up to 3 when
/// touching.
struct GjkResult {
    GjkOutcome outcome = GjkOutcome::stalled;
    int count = 0;
    std::array<SupportPair, 3> simplex;  ///< the first `count`; without initial values, which would cost a warm query
    DVec2 normal;                        ///< unit, from A to B; only when apart
    CorePoints points;                   ///< b − a = distance · normal; only when apart
    double distance = 0;                 ///< of the simplex, metres; when apart, of the cores
    double resolution = 0;               ///< what the coordinates resolve, metres
    bool encloses = false;               ///< touching: the simplex is a triangle with the origin well inside
    int iterations = 0;
};

/// Gilbert, Johnson and Keerthi (1988) in the plane. The simplex is a vertex or a segment of the Minkowski difference;
/// a new support point makes two candidate segments, of which the closer is kept. It ends with a proof: the distance
/// along the current normal (a lower bound) meets the distance of the simplex (an upper bound) within rounding.
/// Most runs end in the walk over neighbouring features that comes first (gjk_run.h), by the same kind of proof.
/// @param warm  simplex to start from, may be null; indices that do not fit are ignored.
GjkResult runGjk(const PairView& pair, const SimplexCache* warm);

/// Keeps the simplex for the next run.
inline void remember(const GjkResult& result, SimplexCache& cache) {
    cache.count = static_cast<std::uint8_t>(result.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(result.count); ++i) {
        cache.indexA[i] = static_cast<std::uint8_t>(result.simplex[i].a);
        cache.indexB[i] = static_cast<std::uint8_t>(result.simplex[i].b);
    }
}

/// The same answer by trying every vertex of each shape against every edge of the other: the way out of `stalled` for
/// cores that are apart. Takes the features whose distance is best proved by the support along their normal: near the
/// end of a face, a vertex gives the same distance in all digits, but half the digits of the normal.
/// @pre the cores do not overlap.
GjkResult closestByExhaustion(const PairView& pair);

/// GJK, with `stalled` resolved: `apart` or `touching`.
GjkResult closestFeatures(const PairView& pair, const SimplexCache* warm);

/// Points of both cores on the simplex of a result, b − a = gap.
CorePoints witnessOf(const PairView& pair, const GjkResult& result, DVec2 gap);

/// Signed separation of the cores, unit normal from A to B and the core points that realise it.
struct CoreSeparation {
    double separation = 0;
    DVec2 normal;
    CorePoints points;
};
/// What a result means: the closest points when apart, else the least penetration.
CoreSeparation coreSeparation(const PairView& pair, const GjkResult& gjk);

}  // namespace swept::inline SWEPT_PRECISION
