#pragma once

#include "../../solver/contacts/contact_constraint.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// A hit of two shapes, slots, of which nothing else is said yet.
inline ContactEvent hitBetween(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB) {
    const Shape& a = world.shapes[shapeA];
    const Shape& b = world.shapes[shapeB];
    return {.type = ContactEventType::hit,
            .shapeA = world.shapes.idOf(a.head),
            .shapeB = world.shapes.idOf(b.head),
            .bodyA = world.bodies.idOf(a.body),
            .bodyB = world.bodies.idOf(b.body),
            .segmentA = a.segmentIndex,
            .segmentB = b.segmentIndex};
}

/// How fast the points of an impact that was solved came together, m/s: the faster one.
Real impactSpeed(const ContactConstraint& impact);

/// What an impact in flight tells: where it was hit hardest.
/// @param centerB  of mass of the second body, world
/// @param fraction  of the step
ContactEvent hitOf(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB, const ContactConstraint& impact,
                   DVec2 centerB, double fraction);

}  // namespace swept::inline SWEPT_PRECISION
