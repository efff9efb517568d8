#include "mouse_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void solveOne(MouseConstraint& joint, const JointPair& pair, Real, bool useBias) {
    if (joint.hasSpring && !useBias) { return; }  // once per sub-step
    const Vec2 arm = rotate(pair.b.deltaRotation, joint.anchorB);
    const HeldRows point = heldPoint(pair, {}, arm);
    const Vec2 gap = anchorOffset(joint, pair.a, pair.b);
    Vec2 total = joint.linearImpulse;
    if (joint.hasSpring) {
        total += springChange(point.matrix, speedsOf(point, pair), gap, total, joint.spring);
    } else {
        total += heldChange(point, pair, gap, total, joint.softness, useBias);
    }
    const UnitAndLength wanted = normalized(total);
    if (wanted.length > joint.maxImpulse) { total = joint.maxImpulse * wanted.unit; }
    apply(point, pair, total - joint.linearImpulse);
    joint.linearImpulse = total;
}

}  // namespace

void prepare(MouseConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<MouseConstraint> joints, const SolverBodies& bodies) {
    for (MouseConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, rotate(b.deltaRotation, joint.anchorB));
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<MouseConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (MouseConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const MouseConstraint& joint) { return {joint.linearImpulse, 0}; }

}  // namespace swept::inline SWEPT_PRECISION
