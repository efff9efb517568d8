#pragma once

#include <span>

#include "world_state.h"

/// A body that slides over ground of several pieces: the ends of the pieces pass under it, and with them the points of
/// its contacts. The impulses that these keep from step to step then press at other places of the body, and turn it: a
/// stack of six boxes that slid over seams at 20 m/s leant by 5 mm after two seconds. So the sum of the impulses and
/// their moment are kept instead, by the two outermost points. Not those of a blow, which is over: repeated in full it
/// would throw the body off.

namespace swept::inline SWEPT_PRECISION {

/// Before the manifold of a contact is renewed: notes what it carried if B has slid along A since.
void noteSlide(Contact& contact, const Transform& bInA);
/// Hands it on among the new points of contacts of one body with static shapes: those linked from `first` on
/// (`WorldState::nextGroundContact`).
void carryAlong(const WorldState& world, std::span<Contact> contacts, std::uint32_t first);

}  // namespace swept::inline SWEPT_PRECISION
