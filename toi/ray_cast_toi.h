#pragma once

#include "time_of_impact.h"

namespace swept {

/// The cheapest cure for tunnelling: each body is taken for the middle of its shape (the mean of its vertices), and
/// that point is cast as a ray along the relative translation against the other shape in its initial pose: B's middle
/// against A, and A's middle, backwards, against B. The earlier hit counts. A ray keeps its shape's radius and the
/// target, so it is exact for circles that do not turn about a point aside.
///
/// @return `hit` at the fraction at which a ray enters (0 if it starts inside), with the pose of the whole motion
///         there, which usually is already overlapping; else `separated`. No bracket.
/// Motion: rotations ignored; parabolas replaced by their chord from fraction 0 to tMax.
/// Source: folklore of games for bullets. Cost: two ray casts and one distance evaluation for the answer.
/// Fails: misses all contacts that neither middle runs into (wide shapes that overlap by less than half), hits late by
/// the half width of the shape, and knows nothing of turning.
Toi rayCastToi(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
               const ToiSettings& settings);

}  // namespace swept
