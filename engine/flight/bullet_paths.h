#pragma once

#include "../state/bullet_work.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether it is a bullet that contacts alone keep on the way that the solver gave it: where that leads through another
/// such body, or one that left its own, or is long, it takes off.
bool mayLeave(const BulletPartner& partner);
/// Where it is on its path at a time of the step, 0 … 1; at the end of it if none of it is left.
double fractionAt(const BulletPartner& partner, double time);
/// The path from a time on. @pre before the end of the step
Sweep pathAfter(const BulletPartner& partner, double time);
/// Where a body that hangs on to another one goes with it from a time on, up to what static or kinematic thing it is
/// pressed against there.
Sweep pathWith(const BulletPartner& rider, const BulletPartner& carrier, double time);
/// Puts a flyer elsewhere at once, or as far on the way as nothing static or kinematic is in it.
void shift(Flight& flight, DVec2 by);

}  // namespace swept::inline SWEPT_PRECISION
