#include "revolute_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Real angleOf(const RevoluteConstraint& joint, const JointPair& pair) {
    return joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
}

void solveOne(RevoluteConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    const HeldRows point = heldPoint(pair, armA, armB);
    const Vec2 gap = joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (armB - armA);
    if (!joint.isHeld || !useBias) {
        const Vec2 change = heldChange(point, pair, gap, joint.linearImpulse, joint.softness, useBias);
        joint.linearImpulse += change;
        apply(point, pair, change);
    }
    if (!joint.hasSpring && !joint.hasMotor && !joint.hasLimits) { return; }
    // The angle last, but guided: the point stays as it was just solved.
    const GuidedRow spin = guidedSpin(point, pair, armA, armB);
    solveFreedom(
        joint, spin.mass, angleOf(joint, pair), joint.softness, h, useBias, [&] { return speedOf(spin.row, pair); },
        [&](Real impulse) { apply(spin, point, pair, impulse, joint.linearImpulse); });
}

}  // namespace

void prepare(RevoluteConstraint& joint, std::span<const BodyInertia>) { dropUnused(joint); }

void warmStart(std::span<RevoluteConstraint> joints, const SolverBodies& bodies) {
    for (RevoluteConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Vec2 armA = rotate(a.deltaRotation, joint.anchorA);
        const Vec2 armB = rotate(b.deltaRotation, joint.anchorB);
        applyImpulse(a, pair.inertiaA, -joint.linearImpulse, armA);
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, armB);
        const Real mass = joint.hasSpring ? guidedSpin(heldPoint(pair, armA, armB), pair, armA, armB).mass : Real(0);
        pushSpring(joint, mass, angleOf(joint, pair));
        apply(kSpinRow, pair, joint.impulse());
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
