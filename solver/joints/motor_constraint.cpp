#include "motor_constraint.h"

#include <algorithm>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Wanted velocities, once per sub-step: they are real, and stay what they are in relaxation.
void aim(MotorConstraint& joint, const JointPair& pair, Real h) {
    if (joint.seeksPlace) {
        const UnitAndLength away = normalized(anchorOffset(joint, pair.a, pair.b));
        const Real inverseMass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
        const Real acceleration = joint.maxLinearImpulse / h * inverseMass;
        joint.velocity = -approachSpeed(away.length, joint.approachRate, acceleration) * away.unit;
    }
    if (joint.seeksAngle) {
        const Real angle = joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
        const Real acceleration = joint.maxAngularImpulse / h * turnOf(pair);
        joint.spin = std::copysign(approachSpeed(std::fabs(angle), joint.approachRate, acceleration), -angle);
    }
}

void driveLine(MotorConstraint& joint, const JointPair& pair) {
    const HeldRows point =
        heldPoint(pair, rotate(pair.a.deltaRotation, joint.anchorA), rotate(pair.b.deltaRotation, joint.anchorB));
    Vec2 total = joint.linearImpulse - solve(point.matrix, speedsOf(point, pair) - joint.velocity);
    const UnitAndLength wanted = normalized(total);
    if (wanted.length > joint.maxLinearImpulse) { total = joint.maxLinearImpulse * wanted.unit; }
    apply(point, pair, total - joint.linearImpulse);
    joint.linearImpulse = total;
}

void driveAngle(MotorConstraint& joint, const JointPair& pair) {
    const Real turn = turnOf(pair);
    if (!(turn > 0)) { return; }
    const Real change =
        motorChange(1 / turn, speedOf(kSpinRow, pair), joint.spin, joint.angularImpulse, joint.maxAngularImpulse);
    joint.angularImpulse += change;
    apply(kSpinRow, pair, change);
}

void solveOne(MotorConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    if (useBias) { aim(joint, pair, h); }
    if (joint.drivesAngle) { driveAngle(joint, pair); }
    if (joint.drivesLine) { driveLine(joint, pair); }
}

}  // namespace

void prepare(MotorConstraint& joint, std::span<const BodyInertia>) {
    if (!joint.drivesLine) { joint.linearImpulse = {}; }
    if (!joint.drivesAngle) { joint.angularImpulse = 0; }
}

void warmStart(std::span<MotorConstraint> joints, const SolverBodies& bodies) {
    for (MotorConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        apply(heldPoint(pair, rotate(a.deltaRotation, joint.anchorA), rotate(b.deltaRotation, joint.anchorB)), pair,
              joint.linearImpulse);
        apply(kSpinRow, pair, joint.angularImpulse);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<MotorConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (MotorConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const MotorConstraint& joint) { return {joint.linearImpulse, joint.angularImpulse}; }

}  // namespace swept::inline SWEPT_PRECISION
