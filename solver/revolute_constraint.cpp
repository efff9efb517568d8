#include "revolute_constraint.h"

#include <algorithm>

#include "point_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

struct JointPair {
    BodyState& a;
    BodyState& b;
    const BodyInertia& inertiaA;
    const BodyInertia& inertiaB;
};

Real relativeSpin(const JointPair& pair) { return pair.b.angularVelocity - pair.a.angularVelocity; }

void applyTwist(const JointPair& pair, Real impulse) {
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * impulse;
}

/// One side of the limits: an impulse that only pushes. @param room  angle left before the limit, negative beyond it
/// @param direction  +1 for the lower limit, −1 for the upper
void solveLimit(const JointPair& pair, const RevoluteConstraint& joint, Real room, Real direction, Real& accumulated,
                Real h, bool useBias) {
    const Real speed = direction * relativeSpin(pair);
    Real change = 0;
    if (room > 0) {
        change = -joint.angularMass * (speed + room / h);  // may reach the limit within this sub-step, no more
    } else {
        const Softness softness = useBias ? joint.softness : kRigid;
        change = scalarChange(joint.angularMass, speed, useBias ? room : Real(0), accumulated, softness);
    }
    const Real total = std::max(accumulated + change, Real(0));
    applyTwist(pair, direction * (total - accumulated));
    accumulated = total;
}

void solveAngle(RevoluteConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    if (!(joint.angularMass > 0)) { return; }  // nothing to turn; and 0 times the room of a limit at infinity is no number
    const Real angle = joint.baseAngle + pair.b.deltaAngle - pair.a.deltaAngle;
    // Once per sub-step: solved again in relaxation, with the angle that it has just made, the spring would damp twice.
    if (joint.hasSpring && useBias) {
        const Real change =
            scalarChange(joint.angularMass, relativeSpin(pair), angle, joint.springImpulse, joint.spring);
        joint.springImpulse += change;
        applyTwist(pair, change);
    }
    if (joint.hasMotor) {
        const Real wanted = joint.motorImpulse - joint.angularMass * (relativeSpin(pair) - joint.motorSpeed);
        const Real total = std::clamp(wanted, -joint.maxMotorImpulse, joint.maxMotorImpulse);
        applyTwist(pair, total - joint.motorImpulse);
        joint.motorImpulse = total;
    }
    if (joint.hasLimits) {
        solveLimit(pair, joint, angle - joint.lower, 1, joint.lowerImpulse, h, useBias);
        solveLimit(pair, joint, joint.upper - angle, -1, joint.upperImpulse, h, useBias);
    }
}

void solvePoint(RevoluteConstraint& joint, const JointPair& pair, bool useBias) {
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    const Vec2 velocity = velocityAt(pair.b, armB) - velocityAt(pair.a, armA);
    const Softness softness = useBias ? joint.softness : kRigid;
    Vec2 error;
    if (useBias) { error = joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (armB - armA); }
    const Vec2 solved = solve(pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB),
                              velocity + softness.biasRate * error);
    const Vec2 change = -softness.massScale * solved - softness.impulseScale * joint.linearImpulse;
    joint.linearImpulse += change;
    applyImpulse(pair.a, pair.inertiaA, -change, armA);
    applyImpulse(pair.b, pair.inertiaB, change, armB);
}

}  // namespace

void prepareRevolute(RevoluteConstraint& joint, std::span<const BodyInertia> inertias) {
    const Real inverse = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia;
    joint.angularMass = inverse > 0 ? 1 / inverse : Real(0);
    if (!joint.hasSpring) { joint.springImpulse = 0; }
    if (!joint.hasMotor) { joint.motorImpulse = 0; }
    if (!joint.hasLimits) { joint.lowerImpulse = joint.upperImpulse = 0; }
}

void warmStartRevolutes(std::span<RevoluteConstraint> joints, const SolverBodies& bodies) {
    for (const RevoluteConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        applyImpulse(a, pair.inertiaA, -joint.linearImpulse, rotate(a.deltaRotation, joint.anchorA));
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, rotate(b.deltaRotation, joint.anchorB));
        applyTwist(pair, joint.springImpulse + joint.motorImpulse + joint.lowerImpulse - joint.upperImpulse);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solveRevolutes(std::span<RevoluteConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (RevoluteConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        solveAngle(joint, pair, h, useBias);
        solvePoint(joint, pair, useBias);  // last: what a user sees first is a joint that comes apart
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

Real anchorGap(const RevoluteConstraint& joint, const BodyState& a, const BodyState& b) {
    return length(joint.centerOffset + (b.deltaPosition - a.deltaPosition) + rotate(b.deltaRotation, joint.anchorB) -
                  rotate(a.deltaRotation, joint.anchorA));
}

}  // namespace swept::inline SWEPT_PRECISION
