#pragma once

#include "gjk.h"
#include "manifold_clip.h"

/// What manifold.cpp is made of, for files of `collide` alone.

namespace swept::inline SWEPT_PRECISION {

/// Separations along two faces are the same up to so much of the coordinates that go in: a few roundings of each.
inline constexpr double kFlushRounding = 8 * static_cast<double>(kEpsilon);

/// A face is preferred to a nearly equal one of the other shape by this fraction of the shorter of both, so that the
/// reference does not change sides from step to step.
inline constexpr double kFacePreference = 0x1p-10;

/// Sine of the angle below which a closest direction counts as a face normal: up to there, the separation along the
/// face normal is the distance, up to one rounding of `Real` (the cosine differs from 1 by half its square). The root
/// of `kEpsilon`.
inline constexpr double kFaceAngle = std::numeric_limits<Real>::digits == 24 ? 0x1.6a09e667f3bcdp-12 : 0x1p-26;

/// Sine of the angle up to which a corner of a chain counts as flat and a direction as the segment's own normal. The
/// separation along the normal then differs from the distance by 2⁻²¹ of it.
inline constexpr double kSeamAngle = 0x1p-10;

/// Roundings of the coordinates, on top of it.
inline constexpr double kSeamRounding = 4 * static_cast<double>(kEpsilon);

/// Of a reach, what a manifold of a segment is surely within that lies beyond its end by the seam angle.
inline constexpr double kSurePart = 1 - kSeamAngle * kSeamAngle;

/// Roundings of coordinates up to which it is doubtful how a core lies over a segment.
inline constexpr double kChainRoundings = 64;

/// Cosine of the angle (about 1/8) up to which an edge lies across the line between two closest vertices.
inline constexpr double kFlatCosine = 1 - 0x1p-7;

/// Manifold against one face. @param slack  as of `clip`
Manifold clipAgainstA(const PairView& pair, int edge, double margin, double slack);
Manifold clipAgainstB(const PairView& pair, int edge, double margin, double slack);

/// `ManifoldReach`, but what is farther apart than `nearest` may have points all the same.
struct Margins {
    double points;
    double nearest;  ///< at most as much
};

/// What is left of a manifold, and what is known then: of points, the deepest is as far away as the shapes are.
inline Manifold within(const Manifold& manifold, Real nearest, PairVerdict& verdict) {
    if (manifold.count == 0 || deepestSeparation(manifold) <= nearest) { return manifold; }
    verdict.verdict = ManifoldMemory::Verdict::apart;
    verdict.room = static_cast<double>(deepestSeparation(manifold));
    return {};
}

/// Any two shapes. @param warm  features to begin at, or null
Manifold collideByGjk(const PairView& pair, Margins margins, const SimplexCache* warm, PairVerdict& verdict);

/// A chain segment, `collide` without its ways around the search: tests compare both. @pre of ordinary size
Manifold collideChainBySearch(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin);

/// Polygons without radius (manifold_sharp.cpp).
Manifold collideSharp(const PairView& pair, Margins margins, PairVerdict& verdict);
/// The same where what they touch with is not the best face, but most likely next to it.
Manifold collideBesideFace(const PairView& pair, int face, bool isOfA, Margins margins, PairVerdict& verdict);
/// Whether stored normals may choose the wrong one of two faces.
bool hasNearlyParallelNeighbour(const Polygon& polygon, int face);
/// The same where the face is known. No points: it is not what they touch with.
Manifold collideOnSharpFace(const PairView& pair, int face, bool isOfA, double margin);

}  // namespace swept::inline SWEPT_PRECISION
