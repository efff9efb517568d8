#include "weld_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The joint as it stands in this sub-step.
struct Seam {
    Vec2 armA;
    Vec2 armB;
    Vec2 gap;
    Real angle;
    HeldRows point;
};

Seam seamOf(const WeldConstraint& joint, const JointPair& pair) {
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    return {armA, armB, joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (armB - armA),
            joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle), heldPoint(pair, armA, armB)};
}

Real turnOf(const JointPair& pair) { return pair.inertiaA.inverseInertia + pair.inertiaB.inverseInertia; }

/// The angle's own change: drag of the spring, once per sub-step, or rigid.
Real angleChange(const WeldConstraint& joint, const Seam& seam, const JointPair& pair, Real mass,
                 const Softness& softness, bool useBias) {
    const Real speed = speedOf(kSpinRow, pair);
    if (!joint.hasAngularSpring) {
        return scalarChange(mass, speed, useBias ? seam.angle : Real(0), joint.angularImpulse,
                            useBias ? softness : kRigid);
    }
    return useBias ? joint.angularSpring.drag * (joint.angularImpulse - mass * speed) : Real(0);
}

/// The angle while the point stays. @param softness  of a rigid one
void solveGuidedAngle(WeldConstraint& joint, const Seam& seam, const JointPair& pair, const Softness& softness,
                      bool useBias) {
    if (!(turnOf(pair) > 0)) { return; }
    const GuidedRow spin = guidedSpin(seam.point, pair, seam.armA, seam.armB);
    const Real twist = angleChange(joint, seam, pair, spin.mass, softness, useBias);
    joint.angularImpulse += twist;
    apply(spin, seam.point, pair, twist, joint.linearImpulse);
}

/// What softness takes back of both, without an answer of either: all rows give way as one block.
void takeBack(WeldConstraint& joint, const Seam& seam, const JointPair& pair) {
    const Vec2 push = -joint.softness.impulseScale * joint.linearImpulse;
    joint.linearImpulse += push;
    apply(seam.point, pair, push);
    if (joint.hasAngularSpring) { return; }
    const Real twist = -joint.softness.impulseScale * joint.angularImpulse;
    joint.angularImpulse += twist;
    apply(kSpinRow, pair, twist);
}

/// The point as if it were rigid, then the angle while the point stays; softness comes last. (Where it took its part of
/// the point first, the bodies turned, and the angle that answered that brought back m·L²/I times as much at a lever L:
/// in a few passes without end.)
void solveAtPoint(WeldConstraint& joint, const Seam& seam, const JointPair& pair, bool useBias) {
    const bool isDone = joint.isHeld && useBias;
    if (!isDone) {
        const Vec2 bias = useBias ? joint.softness.biasRate * seam.gap : Vec2{};
        const Vec2 push = -solve(seam.point.matrix, speedsOf(seam.point, pair) + bias);
        joint.linearImpulse += push;
        apply(seam.point, pair, push);
    }
    if (!isDone || joint.hasAngularSpring) {
        solveGuidedAngle(joint, seam, pair, {.biasRate = joint.softness.biasRate}, useBias);
    }
    if (!isDone && useBias) { takeBack(joint, seam, pair); }
}

void solveAngle(WeldConstraint& joint, const Seam& seam, const JointPair& pair, bool useBias) {
    const Real turn = turnOf(pair);
    if (!(turn > 0) || (joint.isHeld && useBias && !joint.hasAngularSpring)) { return; }
    const Real twist = angleChange(joint, seam, pair, 1 / turn, joint.softness, useBias);
    joint.angularImpulse += twist;
    apply(kSpinRow, pair, twist);
}

/// Response of the points while the angle is held: the bodies move as one, but for what their arms differ.
PointMatrix matrixAtAngle(const Seam& seam, const JointPair& pair) {
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real turn = turnOf(pair);
    const Real both = turn > 0 ? pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia / turn : Real(0);
    const Vec2 arm = seam.armA - seam.armB;
    return {mass + both * square(arm.y), -both * arm.x * arm.y, mass + both * square(arm.x),
            mass * (mass + both * lengthSquared(arm))};
}

/// What the linear spring moves: the points while the angle is held, or while it is a spring, too, as they like.
PointMatrix linearMatrix(const WeldConstraint& joint, const Seam& seam, const JointPair& pair) {
    return joint.hasAngularSpring ? seam.point.matrix : matrixAtAngle(seam, pair);
}

/// Inertia that the angular spring moves.
Real angularMass(const WeldConstraint& joint, const Seam& seam, const JointPair& pair) {
    const Real turn = turnOf(pair);
    if (!(turn > 0)) { return 0; }
    return joint.hasLinearSpring ? 1 / turn : guidedSpin(seam.point, pair, seam.armA, seam.armB).mass;
}

void dragPoint(WeldConstraint& joint, const Seam& seam, const JointPair& pair) {
    const Vec2 wanted = joint.linearImpulse - solve(linearMatrix(joint, seam, pair), speedsOf(seam.point, pair));
    const Vec2 change = joint.linearSpring.drag * wanted;
    joint.linearImpulse += change;
    apply(seam.point, pair, change);
    const Real turn = turnOf(pair);
    if (joint.hasAngularSpring || !(turn > 0)) { return; }
    // A rigid angle stays as it was solved.
    const Real turned = pair.inertiaA.inverseInertia * cross(seam.armA, change) +
                        pair.inertiaB.inverseInertia * cross(seam.armB, change);
    joint.angularImpulse -= turned / turn;
    apply(kSpinRow, pair, -turned / turn);
}

/// The pushes of the springs take the place of their old impulses.
void pushSprings(WeldConstraint& joint, const Seam& seam, const JointPair& pair) {
    if (joint.hasLinearSpring) {
        joint.linearImpulse = -joint.linearSpring.push * solve(linearMatrix(joint, seam, pair), seam.gap);
    }
    if (joint.hasAngularSpring) {
        joint.angularImpulse = -angularMass(joint, seam, pair) * (joint.angularSpring.push * seam.angle);
    }
}

void solveOne(WeldConstraint& joint, const JointPair& pair, Real, bool useBias) {
    const Seam seam = seamOf(joint, pair);
    if (!joint.hasLinearSpring) { return solveAtPoint(joint, seam, pair, useBias); }
    solveAngle(joint, seam, pair, useBias);
    if (useBias) { dragPoint(joint, seam, pair); }
}

}  // namespace

void prepare(WeldConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<WeldConstraint> joints, const SolverBodies& bodies) {
    for (WeldConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Seam seam = seamOf(joint, pair);
        pushSprings(joint, seam, pair);
        apply(seam.point, pair, joint.linearImpulse);
        apply(kSpinRow, pair, joint.angularImpulse);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<WeldConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (WeldConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const WeldConstraint& joint) { return {joint.linearImpulse, joint.angularImpulse}; }

}  // namespace swept::inline SWEPT_PRECISION
