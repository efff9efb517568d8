#pragma once

#include <span>

#include "../state/world_state.h"

/// A body that slides over ground of several pieces: the ends of the pieces pass under it, and with them the points of
/// its contacts. The impulses that these keep from step to step then press at other places of the body, and turn it: a
/// stack of six boxes that slid over seams at 20 m/s leant by 5 mm after two seconds. So the sum of the impulses and
/// their moment are kept instead, by the two outermost points. Not those of a blow, which is over: repeated in full it
/// would throw the body off.

namespace swept::inline SWEPT_PRECISION {

/// What a contact whose manifold is about to be renewed carried if B has slid along A since.
/// @param slide  what becomes of it. (Not returned: a copy of what was just written has to wait for it.)
void noteSlide(Slide& slide, const Contact& contact, const Transform& bInA);

/// The contacts of one body with ground, among others: linked from the first one on.
struct GroundContacts {
    std::span<Contact> all;
    std::span<const Slide> slides;        ///< by contact
    std::span<const std::uint32_t> next;  ///< by contact
    std::uint32_t first = 0;
};

/// Hands it on among the new points of contacts of one body with ground, static or kinematic.
void carryAlong(const WorldState& world, const GroundContacts& contacts);

}  // namespace swept::inline SWEPT_PRECISION
