#pragma once

#include "../state/tolerances.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// What the stage of contacts asks, and what follows from them.
inline bool hasContacts(const WorldState& world) { return !world.probes.empty() || !world.candidates.empty(); }

/// As the stage of contacts saw it, or since something woke.
inline bool isUp(const WorldState& world, std::uint32_t body) { return world.glances[body].isAwake(); }

/// Whether a contact is of what the solver moves in this step: beside a kinematic body at rest it may be of a sleeper.
inline bool isTied(const WorldState& world, const TouchingPair& pair) {
    return (world.traits[pair.dynamicBody()] & kIsTied) != 0;
}

/// What touched goes on to until it is somewhat farther apart.
inline bool isTouching(const Contact& contact) {
    if (contact.manifold.count == 0) { return false; }
    if (contact.sensor) { return true; }
    const Real limit = (contact.touching ? kEndRatio : kBeginRatio) * contact.extent;
    return deepestSeparation(contact.manifold) <= limit;
}

}  // namespace swept::inline SWEPT_PRECISION
