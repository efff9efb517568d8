#pragma once

#include "../state/bullet_work.h"

/// What bullets meet, in order of time.

namespace swept::inline SWEPT_PRECISION {

/// Makes a heap of those that were listed.
void orderMeetings(BulletWork& work);
void pushMeeting(BulletWork& work, const BulletMeeting& meeting);
/// The next meeting, into `BulletWork::together`, and if it is of a pair, all others of bodies that hang together by
/// such of the same moment, as far as sweeps tell: one after the other they would favour who comes first. They are
/// taken off the list. @return false: there is none left in this step
bool takeMeetings(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
