#include "wheel_constraint.h"

#include <cmath>

#include "../wide/wide_wheels.h"
#include "guided_line.h"
#include "pin.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const WheelKernels* wheelKernels() { return nullptr; }
#endif

namespace {

/// The joint as it stands in this sub-step. The force on A acts where B's anchor is.
struct Axle : GuidedLine {
    Real spinCoupled = 0;  ///< of the angle on what is across, 1/(kg·m)
    Real spinInverse = 0;  ///< speed of the angle per impulse, while nothing moves across
};

/// Determinant of a direction and the angle: terms that are all ≥ 0, see `pointMatrix`.
Real determinantWithAngle(const Spins& row, const JointPair& pair) {
    return massOf(pair) * turnOf(pair) +
           pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * square(row.a - row.b);
}

bool isMotored(const WheelConstraint& joint, const JointPair& pair) { return joint.hasMotor && turnOf(pair) > 0; }
bool isSprung(const WheelConstraint& joint) { return joint.suspension.hasSpring || joint.suspension.hasLimits; }

/// @param point  determinant of both directions; @param all  of these and the angle
Real lonelyResponse(const WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real point, Real all) {
    if (isMotored(joint, pair) && isSprung(joint)) {
        const Real rest = determinantWithAngle(axle.along, pair);
        return rest > 0 ? all / rest : axle.response;
    }
    if (isMotored(joint, pair)) { return determinantWithAngle(axle.across, pair) / turnOf(pair); }
    return isSprung(joint) && axle.own > 0 ? point / axle.own : axle.response;
}

Axle axleOf(WheelConstraint& joint, const JointPair& pair) {
    joint.axisNow = rotate(pair.a.deltaRotation, joint.axis);
    const Vec2 offset = anchorOffset(joint, pair.a, pair.b);
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA) + offset;
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    Axle axle{lineAlong(joint.axisNow, offset, armA, armB, pair)};
    axle.spinCoupled = pair.inertiaA.inverseInertia * axle.across.a + pair.inertiaB.inverseInertia * axle.across.b;
    const Real point = pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB).determinant;
    const bool isHeavy = axle.response > 0;
    axle.inverseMass = isHeavy ? point / axle.response : Real(0);
    axle.spinInverse = isHeavy ? determinantWithAngle(axle.across, pair) / axle.response : turnOf(pair);
    if (joint.suspension.hasSpring) {
        joint.suspension.spring = gainsAt(joint.spring, phaseSquaredAt(joint.spring, axle.inverseMass));
    }
    axle.lonely = lonelyResponse(joint, axle, pair, point, fullDeterminant(pair, armA, armB));
    return axle;
}

void driveSpin(WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real given) {
    const GuidedPart spin = guidedPart(axle, axle.spinInverse, turnOf(pair), axle.spinCoupled, given);
    const Real change = motorChange(spin.mass, pair.b.angularVelocity - pair.a.angularVelocity, joint.motorSpeed,
                                    joint.motorImpulse, joint.maxMotorImpulse);
    joint.motorImpulse += change;
    turn(pair, change);
    pushAcross(joint.heldImpulse.x, axle, pair, change * spin.answer);
}

void solveOne(WheelConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Axle axle = axleOf(joint, pair);
    const Real given = complianceOf(joint, useBias) * axle.lonely;
    solveAcross(joint, joint.heldImpulse.x, axle, pair, given, useBias);
    const bool mayDrive = !joint.isDriveHeld || !useBias;
    if (isMotored(joint, pair) && mayDrive) { driveSpin(joint, axle, pair, given); }
    if (!isSprung(joint)) { return; }
    solveAlong(joint, joint.suspension, joint.heldImpulse.x, axle, pair, given, h, useBias);
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
        if (joint.suspension.hasSpring) { joint.heldImpulse.x += warmStartSpring(joint.suspension, axle); }
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
