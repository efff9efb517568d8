#include "pulley_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Vec2 fromWheelA(const PulleyConstraint& joint, const BodyState& a) {
    return joint.offsetA + a.deltaPosition + rotate(a.deltaRotation, joint.anchorA);
}
Vec2 fromWheelB(const PulleyConstraint& joint, const BodyState& b) {
    return joint.offsetB + b.deltaPosition + rotate(b.deltaRotation, joint.anchorB);
}

/// The joint as it stands in this sub-step.
struct Rope {
    Vec2 armA;
    Vec2 armB;
    Real length;  ///< lengthA + ratio·lengthB
    Real mass;
};

Real responseAlong(const BodyInertia& inertia, Vec2 arm, Vec2 axis) {
    return inertia.inverseMass + inertia.inverseInertia * square(cross(arm, axis));
}

Rope ropeOf(PulleyConstraint& joint, const JointPair& pair) {
    const UnitAndLength a = normalized(fromWheelA(joint, pair.a));
    const UnitAndLength b = normalized(fromWheelB(joint, pair.b));
    if (a.length > 0) { joint.axisA = a.unit; }
    if (b.length > 0) { joint.axisB = b.unit; }
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    const Real inverse = responseAlong(pair.inertiaA, armA, joint.axisA) +
                         square(joint.ratio) * responseAlong(pair.inertiaB, armB, joint.axisB);
    return {armA, armB, a.length + joint.ratio * b.length, inverse > 0 ? 1 / inverse : Real(0)};
}

void pull(const PulleyConstraint& joint, const Rope& rope, const JointPair& pair, Real impulse) {
    applyImpulse(pair.a, pair.inertiaA, -impulse * joint.axisA, rope.armA);
    applyImpulse(pair.b, pair.inertiaB, (-impulse * joint.ratio) * joint.axisB, rope.armB);
}

void solveOne(PulleyConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Rope rope = ropeOf(joint, pair);
    if (!(rope.mass > 0)) { return; }
    const Real growth =
        dot(joint.axisA, velocityAt(pair.a, rope.armA)) + joint.ratio * dot(joint.axisB, velocityAt(pair.b, rope.armB));
    const Real change =
        limitChange(passOf(joint, h, useBias), rope.mass, -growth, joint.totalLength - rope.length, joint.tension);
    joint.tension += change;
    pull(joint, rope, pair, change);
}

}  // namespace

void prepare(PulleyConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<PulleyConstraint> joints, const SolverBodies& bodies) {
    for (PulleyConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        pull(joint, ropeOf(joint, pair), pair, joint.tension);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<PulleyConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (PulleyConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const PulleyConstraint& joint) { return {(-joint.tension * joint.ratio) * joint.axisB, 0}; }

Real ropeLength(const PulleyConstraint& joint, const BodyState& a, const BodyState& b) {
    return length(fromWheelA(joint, a)) + joint.ratio * length(fromWheelB(joint, b));
}

}  // namespace swept::inline SWEPT_PRECISION
