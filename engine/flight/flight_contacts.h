#pragma once

#include "../contacts/ghosts.h"
#include "flight_state.h"

namespace swept::inline SWEPT_PRECISION {

/// The flyer among the `states` of its impact; kinematic bodies that it meets follow.
inline constexpr BodySlot kFlyerSlot = 1;

/// Constraints of this moment with static and kinematic shapes of those that the last search found, without ghosts. A
/// body that sank into one of them is set back. What a chain let pass has none.
/// @pre `states` and `inertias` of the scratch are there for the fixed slot and the flyer
void listMet(Flight& flight);

/// One of these, and the shapes that it is of. @pre it was met just now
GroundContact groundContactOf(const Flight& flight, const ContactConstraint& constraint);

}  // namespace swept::inline SWEPT_PRECISION
