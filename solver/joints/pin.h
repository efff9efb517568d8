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

/// What is not to be added up.
inline void pushOnly(const Pin& pin, const JointPair& pair, Vec2 impulse) {
    pair.a.velocity -= pair.inertiaA.inverseMass * impulse;
    pair.b.velocity += pair.inertiaB.inverseMass * impulse;
    pair.a.angularVelocity += pair.inertiaA.inverseInertia * pin.armA.y * impulse.x;
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * pin.armA.x * impulse.y;
    pair.b.angularVelocity -= pair.inertiaB.inverseInertia * pin.armB.y * impulse.x;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * pin.armB.x * impulse.y;
}
template <class Joint>
void push(Joint& joint, const Pin& pin, const JointPair& pair, Vec2 impulse) {
    pushOnly(pin, pair, impulse);
    joint.linearImpulse += impulse;
}

inline Real speedOfSpin(const JointPair& pair) { return pair.b.angularVelocity - pair.a.angularVelocity; }
/// Turns the bodies, and leaves the point to itself.
inline void turn(const JointPair& pair, Real impulse) {
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * impulse;
}

/// What of the points is left to give way while the angle is held: the bodies move as one, but for what their arms
/// differ. (S = K − p·pᵀ/k of the names below, whose terms cancel.)
inline PointMatrix matrixAtAngle(const Pin& pin, const JointPair& pair) {
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real turns = turnOf(pair);
    const Real both = turns > 0 ? pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia / turns : Real(0);
    const Vec2 arm = pin.armA - pin.armB;
    return {mass + both * square(arm.y), -both * arm.x * arm.y, mass + both * square(arm.x),
            mass * (mass + both * lengthSquared(arm))};
}

/// Speed of the points per impulse on the angle.
inline Vec2 pullOf(const Pin& pin, const JointPair& pair) {
    return {-(pair.inertiaA.inverseInertia * pin.armA.y + pair.inertiaB.inverseInertia * pin.armB.y),
            pair.inertiaA.inverseInertia * pin.armA.x + pair.inertiaB.inverseInertia * pin.armB.x};
}

/// The angle is pushed while the points stay as they are: each unit of impulse on it brings `answer` on them. Both are
/// one block that is solved exactly, however long the arms; and a spring between hinged bodies has the inertia that it
/// really moves.
///
/// The points, matrix K, and the angle, with `pullOf` p and own response k, may be soft in the points. By how much is
/// told by what is left of their response while the angle is held, too: S, and K + γ·S is what is solved. (By γ·K a
/// body at a lever L, turned by a motor, hung on rows that were 1 + m·L²/I times as soft as its mass asks for. And
/// where the points were soft and the angle's answer was rigid, the two passed on what softness took back with that
/// factor, without end.)
///
/// Nothing here is a difference of what is m·L²/I times as large. (K − p·pᵀ/k, and K⁻¹·p by the entries of K, were: in
/// float from a lever of a hundred radii on more was lost than there is, and springs and limits gave energy without
/// end.)
struct Spin {
    Real mass = 0;  ///< impulse per speed, kg·m²; 0 when nothing can turn
    Vec2 answer;
    PointMatrix given;        ///< γ·S, without determinant
    PointMatrix pointMatrix;  ///< K + γ·S
};

/// @param compliance  γ, of the point
inline Spin spinOf(const Pin& pin, const JointPair& pair, Real compliance) {
    const Real turns = turnOf(pair);
    // Without mass to resist it the point is held by nothing: bodies that only turn.
    const bool heavy = pin.matrix.determinant > 0;
    const Real inverse = heavy ? fullDeterminant(pair, pin.armA, pin.armB) / pin.matrix.determinant : turns;
    if (!(inverse > 0)) { return {0, {}, {}, pin.matrix}; }
    const PointMatrix alone = matrixAtAngle(pin, pair);
    const PointMatrix given{compliance * alone.xx, compliance * alone.xy, compliance * alone.yy, 0};
    const PointMatrix matrix = softened(pin.matrix, given, compliance, inverse, turns);
    // K + γ·S and (1 + γ)·S have the same adjugate along p, which is that of K: m·p, and what both arms do together.
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real both = pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * cross(pin.armA, pin.armB);
    const Vec2 answer = (1 + compliance) * (mass * pullOf(pin, pair) + both * (pin.armB - pin.armA));
    const Real by = matrix.determinant;
    return {guidedMass(compliance, inverse, turns), by > 0 ? Vec2{-answer.x / by, -answer.y / by} : Vec2{}, given,
            matrix};
}

inline Vec2 gapOf(const JointConstraint& joint, const Pin& pin, const JointPair& pair) {
    return joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (pin.armB - pin.armA);
}

}  // namespace swept::inline SWEPT_PRECISION
