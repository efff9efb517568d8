#pragma once

#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// A kinematic surface that turns overtakes what slides along it again and again: a ball that a flipper swings up meets
/// it hundreds of times in a step, and after `maxImpacts` it would stay on it with the speed that it had by then. So
/// once a quarter of those are spent, it sinks in ever farther between two impacts, and is set back with each.

/// Whether the contacts of this moment go on with the ride: they are all of the body that it slides along, and it met
/// that no faster than by sinking in so far. Then they do not bounce.
/// @pre `FlightScratch::constraints` are prepared, and nothing was reflected
bool slidesOn(Flight& flight);
/// Begins, goes on with or ends the ride, by the contacts that were reflected. @param slides  see `slidesOn`
void followRide(Flight& flight, bool slides);
/// At the end of the step: what sank in is set back, and as fast as the surface.
void endRide(Flight& flight);

}  // namespace swept::inline SWEPT_PRECISION
