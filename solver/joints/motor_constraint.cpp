#include "motor_constraint.h"

#include <algorithm>
#include <cmath>

#include "../wide/wide_drives.h"
#include "pin.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const DriveKernels* driveKernels() { return nullptr; }
#endif

namespace {

/// Where others hold the bodies as well, what seeks a pose gives way under its load. @param response  1/(kg·m²)
void easeAngle(MotorConstraint& joint, Real response) {
    if (joint.seeksAngle) { joint.spin -= joint.ease * response * joint.angularImpulse; }
}
void easeLine(MotorConstraint& joint, const PointMatrix& response) {
    if (joint.seeksPlace) { joint.velocity -= joint.ease * product(response, joint.linearImpulse); }
}

/// Whether what a direct solve found pushes as hard as it may, against an excess of speed.
bool goesOn(const MotorConstraint& joint, Vec2 excess) {
    constexpr Real kAlmost = 1 - 16 * kEpsilon;
    return joint.isDriveHeld && length(joint.linearImpulse) >= kAlmost * joint.maxLinearImpulse &&
           dot(joint.linearImpulse, excess) <= 0;
}

void driveLine(MotorConstraint& joint, const JointPair& pair, bool useBias) {
    const Pin pin = pinOf(joint, pair);
    if (useBias) { easeLine(joint, pin.matrix); }
    const Vec2 excess = speedsOf(pin, pair) - joint.velocity;
    if (goesOn(joint, excess)) { return; }
    Vec2 total = joint.linearImpulse - solve(pin.matrix, excess);
    const UnitAndLength wanted = normalized(total);
    if (wanted.length > joint.maxLinearImpulse) { total = joint.maxLinearImpulse * wanted.unit; }
    pushOnly(pin, pair, total - joint.linearImpulse);
    joint.linearImpulse = total;
}

Pin pinOf(const HingeBeside& hinge, const JointPair& pair) {
    const Vec2 armA = rotate(pair.a.deltaRotation, hinge.armA);
    const Vec2 armB = rotate(pair.b.deltaRotation, hinge.armB);
    return {armA, armB, pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB)};
}

void pushHinge(HingeBeside& hinge, const Pin& pin, const JointPair& pair, Vec2 impulse) {
    applyImpulse(pair.a, pair.inertiaA, -impulse, pin.armA);
    applyImpulse(pair.b, pair.inertiaB, impulse, pin.armB);
    hinge.impulse += impulse;
}

void driveBesideHinge(MotorConstraint& joint, const JointPair& pair, bool useBias) {
    const Pin pin = pinOf(joint.hinge, pair);
    const Spin spin = spinOf(pin, pair, complianceOf(joint, useBias));
    if (!(spin.mass > 0)) { return; }
    if (useBias) { easeAngle(joint, 1 / spin.mass); }
    const Real change =
        motorChange(spin.mass, speedOfSpin(pair), joint.spin, joint.angularImpulse, joint.maxAngularImpulse);
    joint.angularImpulse += change;
    joint.hinge.guided += change;
    turn(pair, change);
    pushHinge(joint.hinge, pin, pair, change * spin.answer);
}

/// Of a direct solve the hinge knows.
void warmStartHinge(MotorConstraint& joint, const JointPair& pair) {
    joint.hinge.impulse = {};
    if (joint.isDriveHeld) { joint.hinge.guided = 0; }
    if (joint.hinge.guided == 0) { return; }
    const Pin pin = pinOf(joint.hinge, pair);
    pushHinge(joint.hinge, pin, pair, joint.hinge.guided * spinOf(pin, pair, 0).answer);
}

void driveAngle(MotorConstraint& joint, const JointPair& pair, bool useBias) {
    const Real response = turnOf(pair);
    if (!(response > 0)) { return; }
    if (joint.hinge.isThere) {
        driveBesideHinge(joint, pair, useBias);
        return;
    }
    if (useBias) { easeAngle(joint, response); }
    const Real change =
        motorChange(1 / response, speedOfSpin(pair), joint.spin, joint.angularImpulse, joint.maxAngularImpulse);
    joint.angularImpulse += change;
    turn(pair, change);
}

void solveOne(MotorConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    if (useBias && joint.isDriveHeld) { return; }
    if (useBias) { aimDrive(joint, pair, h); }
    if (joint.drivesAngle) { driveAngle(joint, pair, useBias); }
    if (joint.drivesLine) { driveLine(joint, pair, useBias); }
}

}  // namespace

void aimDrive(MotorConstraint& joint, const JointPair& pair, Real h) {
    if (joint.drivesLine && joint.seeksPlace) {
        const UnitAndLength away = normalized(anchorOffset(joint, pair.a, pair.b));
        const Real inverseMass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
        const Real acceleration = joint.maxLinearImpulse / h * inverseMass;
        joint.velocity = -approachSpeed(away.length, joint.approachRate, acceleration) * away.unit;
    }
    if (joint.drivesAngle && joint.seeksAngle) {
        const Real angle = joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
        const Real acceleration = joint.maxAngularImpulse / h * turnOf(pair);
        joint.spin = std::copysign(approachSpeed(std::fabs(angle), joint.approachRate, acceleration), -angle);
    }
}

void prepare(MotorConstraint& joint, std::span<const BodyInertia>) {
    if (!joint.drivesLine) { joint.linearImpulse = {}; }
    if (!joint.drivesAngle) { joint.angularImpulse = 0; }
    if (!joint.drivesAngle || !joint.hinge.isThere) { joint.hinge.guided = 0; }
    joint.hinge.total = {};
}

void warmStart(std::span<MotorConstraint> joints, const SolverBodies& bodies) {
    for (MotorConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        if (joint.drivesLine) { pushOnly(pinOf(joint, pair), pair, joint.linearImpulse); }
        if (joint.drivesAngle) { turn(pair, joint.angularImpulse); }
        warmStartHinge(joint, pair);
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

void addUpReactions(std::span<MotorConstraint> joints) {
    addUpReactions<MotorConstraint>(joints);
    for (MotorConstraint& joint : joints) { joint.hinge.total += joint.hinge.impulse; }
}

}  // namespace swept::inline SWEPT_PRECISION
