#pragma once

#include "../state/solve_outcome.h"
#include "../state/world_state.h"

/// Before a solve that may be taken back, and when it is: with too few sub-steps for an error budget, searched in vain,
/// or into something that the whole of it meets on its way. (Joints are remembered as a whole.)

namespace swept::inline SWEPT_PRECISION {

inline BodyOutcome outcomeOf(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    return {.motion = world.motions[slot],
            .groundNormal = body.groundNormal,
            .ground = body.ground,
            .flung = body.flung,
            .sunk = body.sunk};
}

/// All but `sunk`, which stays true where it starts anew from the same place.
inline void restore(WorldState& world, std::uint32_t slot, const BodyOutcome& before) {
    Body& body = world.bodies[slot];
    world.motions[slot] = before.motion;
    body.groundNormal = before.groundNormal;
    body.ground = before.ground;
    body.flung = before.flung;
}

/// @param index  of the contact
inline ContactOutcome outcomeOf(const Contact& contact, std::uint32_t index) {
    return {.contact = index,
            .normalImpulse = contact.normalImpulse,
            .tangentImpulse = contact.tangentImpulse,
            .totalImpulse = contact.totalImpulse,
            .pressed = contact.pressed,
            .pressedOn = contact.pressedOn};
}

inline void restore(Contact& contact, const ContactOutcome& before) {
    contact.normalImpulse = before.normalImpulse;
    contact.tangentImpulse = before.tangentImpulse;
    contact.totalImpulse = before.totalImpulse;
    contact.pressed = before.pressed;
    contact.pressedOn = before.pressedOn;
}

}  // namespace swept::inline SWEPT_PRECISION
