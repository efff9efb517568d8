#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether no other dynamic body has a part in what joints hold a body by.
bool isHeldByGround(const WorldState& world, std::uint32_t body);

/// How a body answers to a blow, as the joints let it that hold it to the ground: what is welded to the level does not
/// yield at all, and what falls on it bounces off as off the level; a flap yields as it turns about its hinge. Rigid
/// points, angles, rods, and limits into which the blow drives it, hold; springs and motors do not. What other bodies
/// have a part in answers freely: its joints have to pass the blow on.
/// @param arm  where it is struck, from its centre of mass, world, metres
/// @param direction  of the blow on it, world, unit
/// @pre dynamic, with mass
BlowAnswer answerOf(const WorldState& world, std::uint32_t body, Vec2 arm, Vec2 direction);

/// The middle of the points of a contact, from the centres of both bodies, metres.
struct BlowArms {
    Vec2 a{};
    Vec2 b{};
};
inline BlowArms armsOf(const ContactConstraint& constraint) {
    const ContactConstraintPoint& first = constraint.points[0];
    const ContactConstraintPoint& last = constraint.points[constraint.count < 2 ? 0 : 1];
    return {Real(0.5) * (first.anchorA + last.anchorA), Real(0.5) * (first.anchorB + last.anchorB)};
}

/// Of the bodies of a contact that may bounce in this step: where both are dynamic, and what is held goes as its joints
/// let it.
void setAnswers(const WorldState& world, const Contact& contact, ContactConstraint& constraint);

}  // namespace swept::inline SWEPT_PRECISION
