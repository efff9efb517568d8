#pragma once

#include "time_of_impact.h"

namespace swept {

/// A speculative contact (P. Firth, "Speculative contacts", 2011; in Box2D and other engines since): not a search for a
/// time at all, but a constraint for the solver. With the separation and the closest points of the start it allows them
/// to approach each other by the gap above the target and no more. Read as a time of impact: where the approach of
/// those two points, at the mean velocities of the step, uses up the gap.
///
/// @return `hit` at the fraction at which the constraint stops the body, with the pose of the whole motion there;
///         `separated` when the constraint does nothing. States at the start as in `timeOfImpact`. No bracket.
/// Motion: the closest points move on straight lines, with their velocity of turning at the start; of the parabola only
/// the mean velocity counts, as in a solver.
/// Cost: two distance evaluations (start and answer).
/// Fails: with ghost hits, in mid-air, on whatever passes by (the closest direction of the start acts as an endless
/// wall); and misses what turns in later or touches elsewhere than at the closest points.
Toi speculativeContact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                       const ToiSettings& settings);

}  // namespace swept
