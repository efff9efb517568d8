#include "weld_constraint.h"

#include "pin.h"
#include "wide_welds.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const WeldKernels* weldKernels() { return nullptr; }
#endif

namespace {

/// The joint as it stands in this sub-step.
struct Seam {
    Vec2 armA;
    Vec2 armB;
    Vec2 gap;
    Real angle;
    HeldRows point;
};

Real angleOf(const WeldConstraint& joint, const JointPair& pair) {
    return joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
}

Seam seamOf(const WeldConstraint& joint, const JointPair& pair) {
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    return {armA, armB, joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (armB - armA),
            angleOf(joint, pair), heldPoint(pair, armA, armB)};
}

void turnBy(WeldConstraint& joint, const JointPair& pair, Real twist) {
    joint.angularImpulse += twist;
    turn(pair, twist);
}

void pushBy(WeldConstraint& joint, const Seam& seam, const JointPair& pair, Vec2 push) {
    joint.linearImpulse += push;
    apply(seam.point, pair, push);
}

/// All three rows: the point as if it were rigid, then the angle while the point stays; softness comes last, of all of
/// them as one block. (Where it took its part of the point first, the bodies turned, and the angle that answered that
/// brought back m·L²/I times as much at a lever L: in a few passes without end.)
void solveRigid(WeldConstraint& joint, const JointPair& pair, bool useBias) {
    if (joint.isHeld && useBias) { return; }
    const Pin pin = pinOf(joint, pair);
    const Spin spin = spinOf(pin, pair, 0);
    Vec2 speeds = speedsOf(pin, pair);
    if (useBias) { speeds += joint.softness.biasRate * gapOf(joint, pin, pair); }
    push(joint, pin, pair, -solve(pin.matrix, speeds));
    Real turning = pair.b.angularVelocity - pair.a.angularVelocity;
    if (useBias) { turning += joint.softness.biasRate * angleOf(joint, pair); }
    const Real twist = -spin.mass * turning;
    turnBy(joint, pair, twist);
    push(joint, pin, pair, twist * spin.answer);
    if (!useBias) { return; }
    push(joint, pin, pair, -joint.softness.impulseScale * joint.linearImpulse);
    turnBy(joint, pair, -joint.softness.impulseScale * joint.angularImpulse);
}

Real springDrag(const WeldConstraint& joint, const JointPair& pair, Real mass) {
    return joint.angularSpring.drag * (joint.angularImpulse - mass * speedOf(kSpinRow, pair));
}

Vec2 springDrag(const WeldConstraint& joint, const Seam& seam, const JointPair& pair, const PointMatrix& matrix) {
    return joint.linearSpring.drag * (joint.linearImpulse - solve(matrix, speedsOf(seam.point, pair)));
}

/// The point, then, once per sub-step, the drag of the angle's spring while the point stays.
void solveTwisted(WeldConstraint& joint, const Seam& seam, const JointPair& pair, bool useBias) {
    const GuidedRow spin = guidedSpin(seam.point, pair, seam.armA, seam.armB, complianceOf(joint, useBias));
    if (!joint.isHeld || !useBias) {
        solveGuiding(spin, seam.point, pair, useBias ? joint.softness.biasRate * seam.gap : Vec2{},
                     joint.linearImpulse);
    }
    if (!useBias) { return; }
    const Real twist = springDrag(joint, pair, spin.mass);
    joint.angularImpulse += twist;
    apply(spin, seam.point, pair, twist, joint.linearImpulse);
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

/// The angle, and the points that it guides: `GuidedRow` with the parts exchanged.
struct StiffAngle {
    Real given = 0;      ///< γ·S
    Real response = 0;   ///< k + γ·S; 0 of bodies that cannot turn
    Vec2 pull;           ///< of the angle on the points
    PointMatrix points;  ///< response of the points with the answer of the angle
};

StiffAngle stiffAngleOf(const Seam& seam, const JointPair& pair, Real compliance) {
    const PointMatrix firm = matrixAtAngle(seam, pair);
    const Real turn = turnOf(pair);
    if (!(turn > 0)) { return {0, 0, {}, firm}; }
    const GuidedRow spin = guidedSpin(seam.point, pair, seam.armA, seam.armB, 0);
    const Real given = spin.mass > 0 ? compliance / spin.mass : Real(0);
    const Vec2 pull{coupling(kSpinRow, seam.point.first, pair), coupling(kSpinRow, seam.point.second, pair)};
    const Real more = given / (turn * (turn + given));
    return {given,
            turn + given,
            pull,
            {firm.xx + more * square(pull.x), firm.xy + more * pull.x * pull.y, firm.yy + more * square(pull.y),
             firm.determinant * (1 + more * dot(pull, solve(firm, pull)))}};
}

/// The angle, then, once per sub-step, the drag of the point's spring while the angle stays.
void solveHung(WeldConstraint& joint, const Seam& seam, const JointPair& pair, bool useBias) {
    const StiffAngle angle = stiffAngleOf(seam, pair, complianceOf(joint, useBias));
    const bool canTurn = angle.response > 0;
    if (canTurn && (!joint.isHeld || !useBias)) {
        const Real bias = useBias ? joint.softness.biasRate * seam.angle : Real(0);
        turnBy(joint, pair, -(speedOf(kSpinRow, pair) + bias + angle.given * joint.angularImpulse) / angle.response);
    }
    if (!useBias) { return; }
    const Vec2 push = springDrag(joint, seam, pair, angle.points);
    pushBy(joint, seam, pair, push);
    if (canTurn) { turnBy(joint, pair, -dot(angle.pull, push) / angle.response); }
}

/// Two springs that do not know of each other drag once per sub-step.
void solveSprings(WeldConstraint& joint, const Seam& seam, const JointPair& pair, bool useBias) {
    if (!useBias) { return; }
    if (turnOf(pair) > 0) { turnBy(joint, pair, springDrag(joint, pair, 1 / turnOf(pair))); }
    pushBy(joint, seam, pair, springDrag(joint, seam, pair, seam.point.matrix));
}

/// The pushes of the springs take the place of their old impulses; what is rigid answers to the change.
void pushSprings(WeldConstraint& joint, const Seam& seam, const JointPair& pair) {
    const Real turn = turnOf(pair);
    if (joint.hasLinearSpring) {
        // The points while the angle is held, or while it is a spring, too, as they like.
        const PointMatrix matrix = joint.hasAngularSpring ? seam.point.matrix : matrixAtAngle(seam, pair);
        const Vec2 before = joint.linearImpulse;
        joint.linearImpulse = -joint.linearSpring.push * solve(matrix, seam.gap);
        if (!joint.hasAngularSpring && turn > 0) {
            const Vec2 pull{coupling(kSpinRow, seam.point.first, pair), coupling(kSpinRow, seam.point.second, pair)};
            joint.angularImpulse -= dot(pull, joint.linearImpulse - before) / turn;
        }
    }
    if (!joint.hasAngularSpring) { return; }
    const Real before = joint.angularImpulse;
    const GuidedRow spin = guidedSpin(seam.point, pair, seam.armA, seam.armB, 0);
    const Real mass = joint.hasLinearSpring ? (turn > 0 ? 1 / turn : Real(0)) : spin.mass;
    joint.angularImpulse = -mass * (joint.angularSpring.push * seam.angle);
    if (!joint.hasLinearSpring) { joint.linearImpulse += (joint.angularImpulse - before) * spin.answer; }
}

void solveOne(WeldConstraint& joint, const JointPair& pair, bool useBias) {
    if (!joint.hasLinearSpring && !joint.hasAngularSpring) { return solveRigid(joint, pair, useBias); }
    const Seam seam = seamOf(joint, pair);
    if (!joint.hasLinearSpring) { return solveTwisted(joint, seam, pair, useBias); }
    joint.hasAngularSpring ? solveSprings(joint, seam, pair, useBias) : solveHung(joint, seam, pair, useBias);
}

}  // namespace

void prepare(WeldConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<WeldConstraint> joints, const SolverBodies& bodies) {
    for (WeldConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        if (joint.hasLinearSpring || joint.hasAngularSpring) { pushSprings(joint, seamOf(joint, pair), pair); }
        applyImpulse(a, pair.inertiaA, -joint.linearImpulse, rotate(a.deltaRotation, joint.anchorA));
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, rotate(b.deltaRotation, joint.anchorB));
        turn(pair, joint.angularImpulse);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<WeldConstraint> joints, const SolverBodies& bodies, Real, bool useBias) {
    for (WeldConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const WeldConstraint& joint) { return {joint.linearImpulse, joint.angularImpulse}; }

}  // namespace swept::inline SWEPT_PRECISION
