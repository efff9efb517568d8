#pragma once

#include <cstdint>
#include <span>

#include "../state/world_state.h"

/// What follows from the manifolds of contacts: begin and end of touching, and who wakes whom.

namespace swept::inline SWEPT_PRECISION {

/// A contact with points, as roles and islands are told of it. @param place  of the contact
TouchingPair touchingPair(const Contact& contact, std::uint32_t place);
/// Of what `isTold`.
inline TouchingPair touchingPair(const ContactProbe& probe) { return {probe, probe.contact, probe.bodyA, probe.bodyB}; }
/// Whether the probe of a contact tells all: mostly.
inline bool isTold(const ContactProbe& probe) {
    return (int{probe.state == ContactState::near} & int{probe.areUp} & int{!probe.turns}) != 0;
}
/// Of a contact whose manifold is new, or which sleeps with points. @return whether it has some
bool noticeOther(WorldState& world, ContactProbe& probe);

/// Of what a later stage woke: its contacts are listed, too.
void listUnparked(WorldState& world);
/// Of those (near_update.h) that hold all the same: that they are part of what touches.
void listHemmed(WorldState& world, std::span<const std::uint32_t> probes);

}  // namespace swept::inline SWEPT_PRECISION
