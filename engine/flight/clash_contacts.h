#pragma once

#include "clash.h"

namespace swept::inline SWEPT_PRECISION {

/// A clash on its way through the step.
struct Clash {
    WorldState& world;
    FlightScratch& scratch;
    ClashScratch& work;
    double dt;
};

/// Contacts of this moment between members: approaching velocities are reflected, all together.
/// @param isStart  nothing has moved yet, so they are those of the step
void resolvePairs(Clash& clash, bool isStart);
/// Whether all that overlaps deeply is on its way out. @pre nothing has moved since the last `resolvePairs`
bool allLeave(const Clash& clash);

}  // namespace swept::inline SWEPT_PRECISION
