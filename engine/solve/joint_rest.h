#pragma once

#include <algorithm>
#include <span>
#include <type_traits>

#include "../../solver/joints/pin.h"
#include "../state/world_state.h"

/// What is built stands as it was built. Joints that are iterated are springs, the stiffest that sub-steps sample, and
/// give way under a load. A structure whose joints begin with the right impulses (joint_start.h) would sink in on them
/// all the same, and swing as if they had begun without. So each has a load at rest, that of its beginning, under which
/// its spring has the length that it was given: the place that the spring seeks is shifted by what that load makes it
/// give way. What is on the move loses it again.

namespace swept::inline SWEPT_PRECISION {

/// Way, to the other side, that undoes what softness makes a joint give way; of a speed that it would have of its
/// impulse in a sub-step.
inline Real restShiftOf(const Softness& softness) {
    return -softness.impulseScale / ((1 - softness.impulseScale) * softness.biasRate);
}

/// Shift of the point of a hinge. @param impulse  that of its load in a sub-step
inline Vec2 restGap(const JointPair& pair, Vec2 armA, Vec2 armB, bool isGuided, const Softness& softness,
                    Vec2 impulse) {
    const Pin pin{armA, armB, pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB)};
    return restShiftOf(softness) * product(isGuided ? matrixAtAngle(pin, pair) : pin.matrix, impulse);
}

/// As a solve has it: that of the fixed world is zero. (Those of the batch may not be set yet.)
inline BodyInertia inertiaIn(const WorldState& world, BodySlot slot, std::uint32_t body) {
    if (slot == kFixedSlot) { return {}; }
    return {world.bodies[body].inverseMass, world.bodies[body].inverseInertia};
}

/// Shifts what the constraint of a joint seeks. @pre it is filled in, and iterated. @param h  s, of a sub-step
template <class Constraint>
void bear(Constraint& constraint, const WorldState& world, const Joint& joint, Real h) {
    if (!joint.restLoad.any()) { return; }
    BodyState still;
    const BodyInertia ofA = inertiaIn(world, constraint.slotA, joint.bodyA);
    const BodyInertia ofB = inertiaIn(world, constraint.slotB, joint.bodyB);
    const JointPair pair{still, still, ofA, ofB};
    const Vec2 impulse = h * joint.restLoad.force;
    const Vec2 armA = constraint.anchorA;
    const Vec2 armB = constraint.anchorB;
    const Real shift = restShiftOf(constraint.softness);
    if constexpr (std::is_same_v<Constraint, RevoluteConstraint>) {
        const bool isGuided = constraint.hasSpring || constraint.hasMotor || constraint.hasLimits;
        constraint.centerOffset += restGap(pair, armA, armB, isGuided, constraint.softness, impulse);
    } else if constexpr (std::is_same_v<Constraint, WeldConstraint>) {
        const Pin pin{armA, armB, pointMatrix(ofA, armA, ofB, armB)};
        const Vec2 pull = pullOf(pin, pair);
        const Real twist = h * joint.restLoad.torque;
        constraint.centerOffset += shift * (product(pin.matrix, impulse) + twist * pull);
        constraint.baseAngle += shift * (dot(pull, impulse) + turnOf(pair) * twist);
    } else if constexpr (std::is_same_v<Constraint, DistanceConstraint>) {
        const JointRow row = rowAlong(normalized(constraint.centerOffset + armB - armA).unit, armA, armB);
        const Real response = ofA.inverseMass + ofB.inverseMass + ofA.inverseInertia * square(row.spinA) +
                              ofB.inverseInertia * square(row.spinB);
        constraint.length -= shift * response * impulse.x;
    }
}

/// Whether a body does anything but tremble: it is faster than in a fall of a small part of its extent.
bool isOnTheMove(const WorldState& world, std::uint32_t slot);

/// What joints of a batch have more than before becomes part of their loads at rest.
/// @param h  s, of the sub-steps that their impulses are of. @pre `readConstraints` comes later
void addRestLoads(WorldState& world, SolverBatch& batch, Real h);

/// What joints carried in the last step, when they were solved all at once, becomes their loads at rest, where it held
/// their chain in balance: from now on they are iterated.
/// @param chains  lowest bodies, ascending
void bearReactions(WorldState& world, std::span<const std::uint32_t> chains);

/// Once a step is over: loads of what is on the move go down.
void loosenMoving(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
