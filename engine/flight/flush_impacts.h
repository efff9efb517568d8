#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct Flight;
struct FlightScratch;

/// Of a flyer that meets several flush pieces of ground at once only its outermost points matter, as where the solver
/// takes it there (contacts/flush_landings.h): the speeds of all others are between theirs. They stand in one
/// constraint, which is solved exactly, instead of those of the pieces in `FlightScratch::order`.
/// @pre `order` has all constraints, prepared
void mergeFlushImpacts(const Flight& flight);

/// After the impact: the constraints of the pieces have what it did at their points.
void partFlushImpacts(FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
