#pragma once

#include <cstdint>
#include <span>

#include "../state/bullet_work.h"

namespace swept::inline SWEPT_PRECISION {

/// Which bullets meet whom, and when. Bullets and all that is fast around them are partners from the start of the step
/// on, since each may be sent anywhere; what is slow becomes one when the path of a bullet comes to it. Only paths
/// whose boxes overlap are looked at (in a tree), and after an impact only those of the bodies that it changed.

/// Bullets, and what is fast enough to get to where they may get: all with their paths and first meetings.
/// @pre one flight scratch per worker
void findPartners(WorldState& world, double dt);
/// What comes next for partners whose paths changed, by index. May move partners in memory.
void lookAhead(WorldState& world, std::span<const std::uint32_t> partners, FlightScratch& scratch);
/// What a pair does from now on: see `BulletCarrier`. @param normal  zero: it bounced
void setCarrier(BulletWork& work, const BulletMeeting& pair, Vec2 normal);

}  // namespace swept::inline SWEPT_PRECISION
