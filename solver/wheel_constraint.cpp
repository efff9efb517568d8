#include "wheel_constraint.h"

#include <cmath>

#include "pin.h"
#include "wide_wheels.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const WheelKernels* wheelKernels() { return nullptr; }
#endif

namespace {

/// Speed of B relative to A, along a row, per turn of each body.
struct Spins {
    Real a = 0;
    Real b = 0;
};

/// The joint as it stands in this sub-step: its rows along the axis and across it. The force on A acts where B's anchor
/// is.
struct Axle {
    Vec2 axis;
    Spins along;
    Spins across;
    Real place = 0;         ///< of the anchor, along the axis, metres
    Real gap = 0;           ///< from the axis, metres
    Real response = 0;      ///< speed across the axis per impulse, 1/kg
    Real own = 0;           ///< likewise along it
    Real coupled = 0;       ///< of the one on the other
    Real spinCoupled = 0;   ///< of the angle on what is across, 1/(kg·m)
    Real inverseMass = 0;   ///< along the axis while nothing moves across it; 0 when nothing can move
    Real spinInverse = 0;   ///< of the angle, likewise
    Real lonely = 0;        ///< what is left of `response` while all that it guides is held, too: a Schur complement, as a
                            ///< quotient of determinants
};

Real massOf(const JointPair& pair) { return pair.inertiaA.inverseMass + pair.inertiaB.inverseMass; }

/// Determinant of a direction and the angle: terms that are all ≥ 0, see `pointMatrix`.
Real determinantWithAngle(const Spins& row, const JointPair& pair) {
    return massOf(pair) * turnOf(pair) +
           pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * square(row.a - row.b);
}

bool isDriven(const WheelConstraint& joint, const JointPair& pair) { return joint.hasMotor && turnOf(pair) > 0; }
bool isSprung(const WheelConstraint& joint) { return joint.suspension.hasSpring || joint.suspension.hasLimits; }

/// @param point  determinant of both directions; @param all  of these and the angle
Real lonelyResponse(const WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real point, Real all) {
    if (isDriven(joint, pair) && isSprung(joint)) {
        const Real rest = determinantWithAngle(axle.along, pair);
        return rest > 0 ? all / rest : axle.response;
    }
    if (isDriven(joint, pair)) { return determinantWithAngle(axle.across, pair) / turnOf(pair); }
    return isSprung(joint) && axle.own > 0 ? point / axle.own : axle.response;
}

Axle axleOf(WheelConstraint& joint, const JointPair& pair) {
    joint.axisNow = rotate(pair.a.deltaRotation, joint.axis);
    const Vec2 offset = anchorOffset(joint, pair.a, pair.b);
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA) + offset;
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    const Vec2 axis = joint.axisNow;
    const auto response = [&pair](const Spins& p, const Spins& q) {
        return pair.inertiaA.inverseInertia * p.a * q.a + pair.inertiaB.inverseInertia * p.b * q.b;
    };
    Axle axle{.axis = axis,
              .along = {cross(armA, axis), cross(armB, axis)},
              .across = {dot(armA, axis), dot(armB, axis)},
              .place = dot(axis, offset),
              .gap = cross(axis, offset)};
    const Real straight = massOf(pair) * lengthSquared(axis);
    axle.response = straight + response(axle.across, axle.across);
    axle.own = straight + response(axle.along, axle.along);
    axle.coupled = response(axle.along, axle.across);
    axle.spinCoupled = response({1, 1}, axle.across);
    const Real point = pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB).determinant;
    const bool isHeavy = axle.response > 0;
    axle.inverseMass = isHeavy ? point / axle.response : Real(0);
    axle.spinInverse = isHeavy ? determinantWithAngle(axle.across, pair) / axle.response : turnOf(pair);
    axle.lonely = lonelyResponse(joint, axle, pair, point, fullDeterminant(pair, armA, armB));
    return axle;
}

Real speedAcross(const Axle& axle, const JointPair& pair) {
    return cross(axle.axis, pair.b.velocity - pair.a.velocity) + axle.across.b * pair.b.angularVelocity -
           axle.across.a * pair.a.angularVelocity;
}
Real speedAlong(const Axle& axle, const JointPair& pair) {
    return dot(axle.axis, pair.b.velocity - pair.a.velocity) + axle.along.b * pair.b.angularVelocity -
           axle.along.a * pair.a.angularVelocity;
}
Real speedOfSpin(const JointPair& pair) { return pair.b.angularVelocity - pair.a.angularVelocity; }

void push(const JointPair& pair, Vec2 direction, const Spins& row, Real impulse) {
    pair.a.velocity -= (pair.inertiaA.inverseMass * impulse) * direction;
    pair.b.velocity += (pair.inertiaB.inverseMass * impulse) * direction;
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * row.a * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * row.b * impulse;
}
void pushAcross(WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real impulse) {
    joint.heldImpulse.x += impulse;
    push(pair, leftPerp(axle.axis), axle.across, impulse);
}

/// A row that the one across guides, see `guidedByLine`.
struct Guided {
    Real mass = 0;    ///< impulse per speed; 0 when nothing can move
    Real answer = 0;  ///< across, per impulse
};

/// @param inverse  speed per impulse while nothing moves across; @param own  alone; @param coupled  on the row across
/// @param given    γ·S of what is across, 1/kg
Guided guidedBy(const Axle& axle, Real inverse, Real own, Real coupled, Real given) {
    if (!(inverse > 0)) { return {}; }
    if (!(axle.response > 0)) { return {1 / inverse, 0}; }
    const Real across = axle.response + given;
    return {across / (inverse * axle.response + own * given), -coupled / across};
}
Guided guidedAlong(const Axle& axle, Real given) {
    return guidedBy(axle, axle.inverseMass, axle.own, axle.coupled, given);
}

void solveAcross(WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real given, bool useBias) {
    const Real across = axle.response + given;
    if ((joint.isHeld && useBias) || !(across > 0)) { return; }
    Real wanted = speedAcross(axle, pair);
    if (useBias) { wanted += joint.softness.biasRate * axle.gap + given * joint.heldImpulse.x; }
    pushAcross(joint, axle, pair, -wanted / across);
}

void driveSpin(WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real given) {
    const Guided spin = guidedBy(axle, axle.spinInverse, turnOf(pair), axle.spinCoupled, given);
    const Real change =
        motorChange(spin.mass, speedOfSpin(pair), joint.motorSpeed, joint.motorImpulse, joint.maxMotorImpulse);
    joint.motorImpulse += change;
    turn(pair, change);
    pushAcross(joint, axle, pair, change * spin.answer);
}

void solveOne(WheelConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Axle axle = axleOf(joint, pair);
    const Real given = complianceOf(joint, useBias) * axle.lonely;
    solveAcross(joint, axle, pair, given, useBias);
    if (isDriven(joint, pair)) { driveSpin(joint, axle, pair, given); }
    if (!isSprung(joint)) { return; }
    const Guided along = guidedAlong(axle, given);
    solveFreedom(
        joint.suspension, along.mass, axle.place, joint.softness, h, useBias, [&] { return speedAlong(axle, pair); },
        [&](Real impulse) {
            push(pair, axle.axis, axle.along, impulse);
            pushAcross(joint, axle, pair, impulse * along.answer);
        });
}

/// The new push of the spring, and what is held answers to its change.
void warmStartSpring(WheelConstraint& joint, const Axle& axle) {
    const Real before = joint.suspension.springImpulse;
    const Guided along = guidedAlong(axle, 0);
    pushSpring(joint.suspension, along.mass, axle.place);
    joint.heldImpulse.x += (joint.suspension.springImpulse - before) * along.answer;
}

}  // namespace

void prepare(WheelConstraint& joint, std::span<const BodyInertia>) {
    dropUnused(joint.suspension);
    if (!joint.hasMotor) { joint.motorImpulse = 0; }
}

void warmStart(std::span<WheelConstraint> joints, const SolverBodies& bodies) {
    for (WheelConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Axle axle = axleOf(joint, pair);
        if (joint.suspension.hasSpring) { warmStartSpring(joint, axle); }
        push(pair, leftPerp(axle.axis), axle.across, joint.heldImpulse.x);
        push(pair, axle.axis, axle.along, joint.suspension.impulse());
        if (joint.hasMotor) { turn(pair, joint.motorImpulse); }
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<WheelConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (WheelConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const WheelConstraint& joint) {
    return {joint.suspension.impulse() * joint.axisNow + joint.heldImpulse.x * leftPerp(joint.axisNow),
            joint.motorImpulse};
}

Real axisGap(const WheelConstraint& joint, const BodyState& a, const BodyState& b) {
    return std::fabs(cross(rotate(a.deltaRotation, joint.axis), anchorOffset(joint, a, b)));
}

}  // namespace swept::inline SWEPT_PRECISION
