#pragma once

#include "../state/bullet_work.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

inline BulletPartner& partnerIn(BulletWork& work, std::uint32_t slot) { return work.partners[work.indices[slot]]; }

/// Into `members`: all that `together` names.
void listMembers(BulletWork& work);
/// The impacts of one moment, all together: approaching velocities are reflected, and what sank below its target is set
/// apart. @pre the members are where they are at that time
void collideBodies(WorldState& world, FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
