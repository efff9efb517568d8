#pragma once

#include "guided_row.h"
#include "joint_constraint.h"

/// The point that hinges and welds hold: scalar twin of wide_pins.inc.

namespace swept::inline SWEPT_PRECISION {

/// The joint as it stands in this sub-step: two points that are held together.
struct Pin {
    Vec2 armA;
    Vec2 armB;
    PointMatrix matrix;
};

inline Pin pinOf(const JointConstraint& joint, const JointPair& pair) {
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    return {armA, armB, pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB)};
}

inline Vec2 speedsOf(const Pin& pin, const JointPair& pair) {
    const Vec2 moving = pair.b.velocity - pair.a.velocity;
    return {moving.x - pin.armB.y * pair.b.angularVelocity + pin.armA.y * pair.a.angularVelocity,
            moving.y + pin.armB.x * pair.b.angularVelocity - pin.armA.x * pair.a.angularVelocity};
}

template <class Joint>
void push(Joint& joint, const Pin& pin, const JointPair& pair, Vec2 impulse) {
    pair.a.velocity -= pair.inertiaA.inverseMass * impulse;
    pair.b.velocity += pair.inertiaB.inverseMass * impulse;
    pair.a.angularVelocity += pair.inertiaA.inverseInertia * pin.armA.y * impulse.x;
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * pin.armA.x * impulse.y;
    pair.b.angularVelocity -= pair.inertiaB.inverseInertia * pin.armB.y * impulse.x;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * pin.armB.x * impulse.y;
    joint.linearImpulse += impulse;
}

/// Turns the bodies, and leaves the point to itself.
inline void turn(const JointPair& pair, Real impulse) {
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * impulse;
}

/// Turning while the point is held, and the point that guides it; see `GuidedRow`.
struct Spin {
    Real mass = 0;
    Vec2 answer;
    PointMatrix given;
    PointMatrix pointMatrix;
};

/// @param compliance  of the point
inline Spin spinOf(const Pin& pin, const JointPair& pair, Real compliance) {
    const Real turns = turnOf(pair);
    // Without mass to resist it the point is held by nothing: bodies that only turn.
    const bool heavy = pin.matrix.determinant > 0;
    const Real inverse = heavy ? fullDeterminant(pair, pin.armA, pin.armB) / pin.matrix.determinant : turns;
    if (!(inverse > 0)) { return {0, {}, {}, pin.matrix}; }
    const Vec2 pull{-(pair.inertiaA.inverseInertia * pin.armA.y + pair.inertiaB.inverseInertia * pin.armB.y),
                    pair.inertiaA.inverseInertia * pin.armA.x + pair.inertiaB.inverseInertia * pin.armB.x};
    const PointMatrix given = givenBy(pin.matrix, pull, turns, compliance);
    const PointMatrix matrix = softened(pin.matrix, given, compliance, inverse, turns);
    return {guidedMass(compliance, inverse, turns), -solve(matrix, pull), given, matrix};
}

inline Vec2 gapOf(const JointConstraint& joint, const Pin& pin, const JointPair& pair) {
    return joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (pin.armB - pin.armA);
}

}  // namespace swept::inline SWEPT_PRECISION
