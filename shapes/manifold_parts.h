#pragma once

#include "gjk.h"
#include "manifold_clip.h"

/// What manifold.cpp is made of, for files of `collide` alone.

namespace swept::inline SWEPT_PRECISION {

/// A face is preferred to a nearly equal one of the other shape by this fraction of the shorter of both, so that the
/// reference does not change sides from step to step.
inline constexpr double kFacePreference = 0x1p-10;

/// Manifold against one face. @param slack  as of `clip`
Manifold clipAgainstA(const PairView& pair, int edge, double margin, double slack);
Manifold clipAgainstB(const PairView& pair, int edge, double margin, double slack);

/// `ManifoldReach`, but what is farther apart than `nearest` may have points all the same.
struct Margins {
    double points;
    double nearest;  ///< at most as much
};

/// Any two shapes. @param warm  features to begin at, or null
Manifold collideByGjk(const PairView& pair, Margins margins, const SimplexCache* warm, PairVerdict& verdict);

/// Polygons without radius (manifold_sharp.cpp).
Manifold collideSharp(const PairView& pair, Margins margins, PairVerdict& verdict);
/// The same where the face is known. No points: it is not what they touch with.
Manifold collideOnSharpFace(const PairView& pair, int face, bool isOfA, double margin);

}  // namespace swept::inline SWEPT_PRECISION
