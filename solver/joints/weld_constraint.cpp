#include "weld_constraint.h"

#include <algorithm>
#include <cmath>

#include "../wide/wide_welds.h"
#include "pin.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const WeldKernels* weldKernels() { return nullptr; }
#endif

namespace {

Real angleOf(const WeldConstraint& joint, const JointPair& pair) {
    return joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
}

void turnBy(WeldConstraint& joint, const JointPair& pair, Real twist) {
    joint.angularImpulse += twist;
    turn(pair, twist);
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
    Real turning = speedOfSpin(pair);
    if (useBias) { turning += joint.softness.biasRate * angleOf(joint, pair); }
    const Real twist = -spin.mass * turning;
    turnBy(joint, pair, twist);
    push(joint, pin, pair, twist * spin.answer);
    if (!useBias) { return; }
    push(joint, pin, pair, -joint.softness.impulseScale * joint.linearImpulse);
    turnBy(joint, pair, -joint.softness.impulseScale * joint.angularImpulse);
}

Real springDrag(const WeldConstraint& joint, const JointPair& pair, Real mass) {
    return dragChange(joint.angularSpring, joint.angularImpulse, mass * speedOfSpin(pair));
}

/// The point and what its spring needs to know: where that acts, and the way of B's point from A's.
struct Hanging {
    Pin pin;
    Vec2 gap;
};

Hanging hangingOf(const WeldConstraint& joint, const JointPair& pair) {
    Pin pin = pinOf(joint, pair);
    const Vec2 gap = gapOf(joint, pin, pair);
    if (joint.hasLinearSpring) {
        pin.armA += gap;
        pin.matrix = pointMatrix(pair.inertiaA, pin.armA, pair.inertiaB, pin.armB);
    }
    return {pin, gap};
}

/// Gains of the spring in the direction in which it is stiffest, and what its push is a part of: kg.
struct PointGains {
    SpringGains gains;
    PointMatrix stiffness;
};

/// @param matrix  response of the point
PointGains gainsOf(const WeldConstraint& joint, const JointPair& pair, const PointMatrix& matrix) {
    const PointMatrix stiffness = turned(joint.linearSpring.stiffness, pair.a.deltaRotation);
    // The larger eigenvalue of the product: θ².
    const Real half = (stiffness.xx * matrix.xx + 2 * stiffness.xy * matrix.xy + stiffness.yy * matrix.yy) / 2;
    const Real rest = square(half) - stiffness.determinant * matrix.determinant;
    const Real wanted = half + (rest > 0 ? std::sqrt(rest) : Real(0));
    const Real phaseSquared = std::min(wanted, kStiffestPhase * kStiffestPhase);
    SpringGains gains = gainsAt(joint.linearSpring.damping, phaseSquared);
    gains.push = wanted > 0 ? gains.push / wanted : Real(0);
    return {gains, stiffness};
}

/// Response of the point while the angle is held, or while it is a spring, too, as it likes.
PointMatrix responseOf(const WeldConstraint& joint, const Pin& pin, const JointPair& pair) {
    return joint.hasAngularSpring ? pin.matrix : matrixAtAngle(pin, pair);
}

Vec2 springDrag(const WeldConstraint& joint, const Pin& pin, const JointPair& pair, const PointMatrix& matrix) {
    const PointGains spring = gainsOf(joint, pair, responseOf(joint, pin, pair));
    return dragChange(spring.gains, joint.linearImpulse, solve(matrix, speedsOf(pin, pair)));
}

/// The point, then, once per sub-step, the drag of the angle's spring while the point stays.
void solveTwisted(WeldConstraint& joint, const Pin& pin, const JointPair& pair, bool useBias) {
    const Spin spin = spinOf(pin, pair, complianceOf(joint, useBias));
    if (!joint.isHeld || !useBias) {
        Vec2 wanted = speedsOf(pin, pair) + product(spin.given, joint.linearImpulse);
        if (useBias) { wanted += joint.softness.biasRate * gapOf(joint, pin, pair); }
        push(joint, pin, pair, -solve(spin.pointMatrix, wanted));
    }
    if (!useBias) { return; }
    const Real twist = springDrag(joint, pair, spin.mass);
    turnBy(joint, pair, twist);
    push(joint, pin, pair, twist * spin.answer);
}

/// The angle, and the points that it guides: `Spin` with the parts exchanged. What hangs on its own is as soft as what
/// is left of the response while the points are held, S: all of its own, k, at a lever L is 1 + m·L²/I times that, and
/// turned it away from its spring. But a link that other joints hold does not go along with the points: there a row
/// that is nearly rigid is iterated against others without anything that damps it. (A light body that a hinge, an angle
/// and a weld to the ground held burst.)
struct StiffAngle {
    Real given = 0;      ///< γ·S, or γ·k of links
    Real response = 0;   ///< k + that; 0 of bodies that cannot turn
    Vec2 pull;           ///< of the angle on the points
    PointMatrix points;  ///< response of the points with the answer of the angle
};

StiffAngle stiffAngleOf(const Pin& pin, const JointPair& pair, Real compliance, bool isLinked) {
    const PointMatrix firm = matrixAtAngle(pin, pair);
    const Real turn = turnOf(pair);
    if (!(turn > 0)) { return {0, 0, {}, firm}; }
    const Spin spin = spinOf(pin, pair, 0);
    const Real held = spin.mass > 0 ? compliance / spin.mass : Real(0);
    const Real given = isLinked ? compliance * turn : held;
    const Vec2 pull = pullOf(pin, pair);
    const Real more = given / (turn * (turn + given));
    return {given,
            turn + given,
            pull,
            {firm.xx + more * square(pull.x), firm.xy + more * pull.x * pull.y, firm.yy + more * square(pull.y),
             firm.determinant * (1 + more * dot(pull, solve(firm, pull)))}};
}

/// The angle, then, once per sub-step, the drag of the point's spring while the angle stays.
void solveHung(WeldConstraint& joint, const Pin& pin, const JointPair& pair, bool useBias) {
    const StiffAngle angle = stiffAngleOf(pin, pair, complianceOf(joint, useBias), joint.isLinked);
    const bool canTurn = angle.response > 0;
    if (canTurn && (!joint.isHeld || !useBias)) {
        const Real bias = useBias ? joint.softness.biasRate * angleOf(joint, pair) : Real(0);
        turnBy(joint, pair, -(speedOfSpin(pair) + bias + angle.given * joint.angularImpulse) / angle.response);
    }
    if (!useBias) { return; }
    const Vec2 impulse = springDrag(joint, pin, pair, angle.points);
    push(joint, pin, pair, impulse);
    if (canTurn) { turnBy(joint, pair, -dot(angle.pull, impulse) / angle.response); }
}

/// Two springs that do not know of each other drag once per sub-step.
void solveSprings(WeldConstraint& joint, const Pin& pin, const JointPair& pair, bool useBias) {
    if (!useBias) { return; }
    if (turnOf(pair) > 0) { turnBy(joint, pair, springDrag(joint, pair, 1 / turnOf(pair))); }
    push(joint, pin, pair, springDrag(joint, pin, pair, pin.matrix));
}

/// The pushes of the springs take the place of their old impulses; what is rigid answers to the change.
void pushSprings(WeldConstraint& joint, const Hanging& hanging, const JointPair& pair) {
    const Pin& pin = hanging.pin;
    const Real turn = turnOf(pair);
    if (joint.hasLinearSpring) {
        const PointGains spring = gainsOf(joint, pair, responseOf(joint, pin, pair));
        const Vec2 before = joint.linearImpulse;
        joint.linearImpulse = -spring.gains.push * product(spring.stiffness, hanging.gap);
        if (!joint.hasAngularSpring && turn > 0) {
            joint.angularImpulse -= dot(pullOf(pin, pair), joint.linearImpulse - before) / turn;
        }
    }
    if (!joint.hasAngularSpring) { return; }
    const Real before = joint.angularImpulse;
    const Spin spin = spinOf(pin, pair, 0);
    const Real mass = joint.hasLinearSpring ? (turn > 0 ? 1 / turn : Real(0)) : spin.mass;
    joint.angularImpulse = -mass * (joint.angularSpring.push * angleOf(joint, pair));
    if (!joint.hasLinearSpring) { joint.linearImpulse += (joint.angularImpulse - before) * spin.answer; }
}

void solveOne(WeldConstraint& joint, const JointPair& pair, bool useBias) {
    if (!joint.hasLinearSpring && !joint.hasAngularSpring) { return solveRigid(joint, pair, useBias); }
    const Pin pin = hangingOf(joint, pair).pin;
    if (!joint.hasLinearSpring) { return solveTwisted(joint, pin, pair, useBias); }
    joint.hasAngularSpring ? solveSprings(joint, pin, pair, useBias) : solveHung(joint, pin, pair, useBias);
}

}  // namespace

void prepare(WeldConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<WeldConstraint> joints, const SolverBodies& bodies) {
    for (WeldConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Hanging hanging = hangingOf(joint, pair);
        const Pin& pin = hanging.pin;
        if (joint.hasLinearSpring || joint.hasAngularSpring) { pushSprings(joint, hanging, pair); }
        applyImpulse(a, pair.inertiaA, -joint.linearImpulse, pin.armA);
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, pin.armB);
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
