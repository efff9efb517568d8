#pragma once

#include "constraint_builder.h"
#include "tied_group.h"

/// Contacts keep their frame, the normal and the arms about both centres, for a whole solve. Taken at its start, the
/// frame of kinematic ground that turns by θ has the ground go on along the tangents of that time: what rides at the
/// height r over its centre, x beside it, goes straight on, and so slips by x·θ²/2 + r·θ³/6 in each step, however rough
/// the ground is. (A box in a bucket that is swung crept out of it.) So contacts with such ground have the frame of
/// half of its turn: the tangents are then chords of the arcs that it goes.
///
/// Gaps that are measured in that frame are right at the end, to the second order, for what rides. What slips ends
/// where the ground leans by θ/2 more, and that gap grows with the square of the time, as what a point does along a
/// normal that its body turns away from. So it is made part of the arm that this goes by, as if the ground had another
/// radius there.

namespace swept::inline SWEPT_PRECISION {

/// Lists at the desk how ground turns. @pre the bodies of the group have their slots
/// @param time  of the solve, s
void findTurningGround(const WorldState& world, const TiedGroup& group, Real time);

inline bool isTurning(const SolveDesk& desk, BodySlot slot) {
    return !desk.groundTurns.empty() && desk.groundTurns[slot].isAny();
}

inline bool anyTurns(const SolveDesk& desk, BodySlot a, BodySlot b) { return isTurning(desk, a) || isTurning(desk, b); }

/// Whether what is moved in that slot touches ground that turns.
inline bool isOnTurning(const SolveDesk& desk, BodySlot slot) {
    return !desk.groundTurns.empty() && desk.groundTurns[slot].isTouched;
}

/// Of the ground of a contact. @pre one of the two turns
inline const GroundTurn& groundTurnOf(const SolveDesk& desk, BodySlot slotA, BodySlot slotB) {
    return desk.groundTurns[isTurning(desk, slotA) ? slotA : slotB];
}

/// Half way along the turn, about the centre of either: only what lies between the two counts. Their centres are nearer
/// to each other by what the chord is shorter, so that both go as far as the ground does.
inline ContactFrame turned(const ContactFrame& frame, const GroundTurn& turn) {
    const Rotation rotation = turn.half * frame.rotation;
    const Vec2 fromAToB = rotate(turn.half, frame.fromAToB);
    const Vec2 nearer = turn.shortening * fromAToB;
    return {rotation, frame.localCenterA + unrotate(rotation, nearer), fromAToB - nearer};
}

/// `ContactConstraint::radiusA` and B.
struct ContactRadii {
    Real a = 0;
    Real b = 0;
};

/// @pre one of the two is ground that turns
/// @param armA, armB  along the tangent, of the first point, in the frame of half of the turn
ContactRadii radiiOnTurning(const WorldState& world, const TiedGroup& group, const ContactLink& link, Vec2 normal,
                            Real armA, Real armB);
void setTurningRadii(const WorldState& world, const TiedGroup& group, const ContactLink& link,
                     ContactConstraint& constraint);

}  // namespace swept::inline SWEPT_PRECISION
