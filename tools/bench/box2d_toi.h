#pragma once

#include "toi_contestant.h"

namespace swept::bench {

/// `b2TimeOfImpact` of Box2D 2.4.1, judged by its own contract: core distance within max(slop, R − 3 slop) ± slop / 4,
/// R the sum of the radii, slop 5 mm; the tolerance is stretched by a fiftieth, rounding in float is not forgiven else.
/// It is asked, and judged, with the numbers rounded to float. Its motion is ours (centres on lines, angles at a
/// constant rate) as long as there is no acceleration. What it is not asked: accelerated motion; sizes for which it is
/// not made, nanometres and thousands of kilometres; shapes that are not convex any more in float.
/// Iterations: separating axes and steps of the root finder.
std::unique_ptr<ToiContestant> makeBox2dToi();

}  // namespace swept::bench
