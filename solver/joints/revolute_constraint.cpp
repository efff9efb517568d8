#include "revolute_constraint.h"

#include <algorithm>
#include <cmath>

#include "pin.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool hasParts(const FreedomParts& parts) { return parts.hasSpring || parts.hasMotor || parts.hasLimits; }

Real angleOf(const RevoluteConstraint& joint, const JointPair& pair) {
    return joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
}

/// A point that guides nothing.
void solvePoint(RevoluteConstraint& joint, const Pin& pin, const JointPair& pair, bool useBias) {
    if (!useBias) {
        push(joint, pin, pair, -solve(pin.matrix, speedsOf(pin, pair)));
        return;
    }
    if (joint.isHeld) { return; }
    const Vec2 firm = solve(pin.matrix, speedsOf(pin, pair) + joint.softness.biasRate * gapOf(joint, pin, pair));
    push(joint, pin, pair, -joint.softness.massScale * firm - joint.softness.impulseScale * joint.linearImpulse);
}

/// See `kMotorGive`.
Real complianceOf(const RevoluteConstraint& joint, const JointPair& pair, bool useBias) {
    const Real compliance = complianceOf(joint, useBias);
    const Real ofHeavy = std::min(pair.inertiaA.inverseMass, pair.inertiaB.inverseMass);
    const bool isWithin = joint.hasMotor && std::fabs(joint.motorImpulse) < joint.maxMotorImpulse;
    if (!isWithin || !(ofHeavy > 0)) { return compliance; }
    const Real ratio = std::max(pair.inertiaA.inverseMass, pair.inertiaB.inverseMass) / ofHeavy;
    return std::clamp(kMotorGive * ratio, Real(1), kMostMotorGive) * compliance;
}

/// The point, and the angle after it, but guided: the point stays as it was just solved.
void solveParts(RevoluteConstraint& joint, const Pin& pin, const JointPair& pair, Real h, bool useBias) {
    const bool isSoft = useBias && !joint.isHeld;
    const Spin spin = spinOf(pin, pair, complianceOf(joint, pair, useBias));
    if (isSoft) {
        const Vec2 wanted = speedsOf(pin, pair) + joint.softness.biasRate * gapOf(joint, pin, pair);
        push(joint, pin, pair, -solve(spin.pointMatrix, wanted + product(spin.given, joint.linearImpulse)));
    } else if (!useBias) {
        push(joint, pin, pair, -solve(pin.matrix, speedsOf(pin, pair)));
    }
    solveFreedom(
        joint, {spin.mass, angleOf(joint, pair)}, passOf(joint, h, useBias),
        [&] { return pair.b.angularVelocity - pair.a.angularVelocity; },
        [&](Real impulse) {
            turn(pair, impulse);
            push(joint, pin, pair, impulse * spin.answer);
        });
}

/// The new push of the spring, and what the point answers to its change.
void warmStartSpring(RevoluteConstraint& joint, const Pin& pin, const JointPair& pair) {
    const Real before = joint.springImpulse;
    const Spin spin = joint.hasSpring ? spinOf(pin, pair, 0) : Spin{};
    pushSpring(joint, spin.mass, angleOf(joint, pair));
    joint.linearImpulse += (joint.springImpulse - before) * spin.answer;
}

void solveOne(RevoluteConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Pin pin = pinOf(joint, pair);
    if (hasParts(joint)) {
        solveParts(joint, pin, pair, h, useBias);
    } else {
        solvePoint(joint, pin, pair, useBias);
    }
}

}  // namespace

void prepare(RevoluteConstraint& joint, std::span<const BodyInertia>) { dropUnused(joint); }

void warmStart(std::span<RevoluteConstraint> joints, const SolverBodies& bodies) {
    for (RevoluteConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Pin pin = pinOf(joint, pair);
        warmStartSpring(joint, pin, pair);
        applyImpulse(a, pair.inertiaA, -joint.linearImpulse, pin.armA);
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, pin.armB);
        if (hasParts(joint)) { turn(pair, joint.impulse()); }
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<RevoluteConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (RevoluteConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const RevoluteConstraint& joint) { return {joint.linearImpulse, joint.impulse()}; }

Real anchorGap(const JointConstraint& joint, const BodyState& a, const BodyState& b) {
    return length(anchorOffset(joint, a, b));
}

}  // namespace swept::inline SWEPT_PRECISION
