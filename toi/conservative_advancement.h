#pragma once

#include "time_of_impact.h"

namespace swept {

/// Conservative advancement (B. Mirtich, "Impulse-based dynamic simulation of rigid body systems", thesis, Berkeley
/// 1996): measure the distance, divide by a bound on the speed at which the bodies can approach along the closest
/// direction, advance by that time, repeat. The bound is first-order: the approach of the centres plus |ω|·r_max of
/// each body, r_max the distance of its farthest vertex from the centre of mass.
///
/// @return as `timeOfImpact`, with the same certificate. `failed` when the budget of 2¹⁸ distance evaluations is spent;
///         the fraction is safe.
/// Motion: complete; on parabolas the greatest approach speed over the rest of the sweep bounds the centres.
/// Cost: one distance evaluation a step. Few steps where translation rules. Where a body turns, even away, the term of
/// turning never shrinks: each step gains only a part of the gap, and steps become as short as tolerance / speed. A
/// shape that turns about a point near the other takes hundreds to thousands of steps, at fine tolerances more.
/// Fails: never wrong, only slow.
Toi conservativeAdvancement(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                            const ToiSettings& settings);

/// Steps are at least half a tolerance long, measured along the fastest path: this allows for paths of 2¹⁷ tolerances
/// at the least. Beyond that the answer would take some tens of milliseconds.
inline constexpr int kMaxAdvancementSteps = 1 << 18;

}  // namespace swept
