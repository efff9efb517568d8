#include "mouse_constraint.h"

#include <cmath>
#include <limits>

namespace swept::inline SWEPT_PRECISION {
namespace {

Vec2 limited(Vec2 impulse, Real most) {
    if (std::fabs(impulse.x) + std::fabs(impulse.y) <= most) { return impulse; }  // the usual case, and at once
    const UnitAndLength wanted = normalized(impulse);
    return wanted.length > most ? most * wanted.unit : impulse;
}

HeldRows gripOf(const MouseConstraint& joint, const JointPair& pair) {
    return heldPoint(pair, {}, rotate(pair.b.deltaRotation, joint.anchorB));
}

Vec2 awayFromTarget(const MouseConstraint& joint, const JointPair& pair) {
    return anchorOffset(joint, pair.a, pair.b) - joint.gone;
}

/// The push of the spring takes the place of its old impulse.
void pushSpring(MouseConstraint& joint, const JointPair& pair, const HeldRows& grip) {
    joint.springImpulse = -joint.spring.push * solve(grip.matrix, awayFromTarget(joint, pair));
    joint.linearImpulse = limited(joint.springImpulse, joint.maxImpulse);
}

/// The speed that the target is approached with, once per sub-step: it is real, and stays in relaxation.
void aim(MouseConstraint& joint, const JointPair& pair, const HeldRows& grip, Real h) {
    const UnitAndLength away = normalized(awayFromTarget(joint, pair));
    const Real acceleration = joint.maxImpulse / h * dot(product(grip.matrix, away.unit), away.unit);
    joint.velocity = -approachSpeed(away.length, joint.approachRate, acceleration) * away.unit;
}

void solveOne(MouseConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const HeldRows grip = gripOf(joint, pair);
    Vec2 total = joint.linearImpulse;
    if (joint.hasSpring) {
        // The speed without what of the push was applied.
        const Vec2 speed = solve(grip.matrix, speedsOf(grip, pair)) - joint.linearImpulse;
        total = (1 + joint.spring.lag - joint.spring.drag) * joint.springImpulse - joint.spring.drag * speed;
    } else if (joint.maxImpulse < std::numeric_limits<Real>::infinity()) {
        if (useBias) { aim(joint, pair, grip, h); }
        total -= solve(grip.matrix, speedsOf(grip, pair) - joint.pace - joint.velocity);
    } else {
        total += heldChange(grip, pair, awayFromTarget(joint, pair), total, joint.softness, useBias, joint.pace);
    }
    total = limited(total, joint.maxImpulse);
    apply(grip, pair, total - joint.linearImpulse);
    joint.linearImpulse = total;
    if (!useBias) { return; }
    // With the bodies: these move next.
    joint.gone += h * joint.pace;
    joint.toGo -= h * joint.pace;
}

}  // namespace

void prepare(MouseConstraint&, std::span<const BodyInertia>) {}

void warmStart(std::span<MouseConstraint> joints, const SolverBodies& bodies) {
    for (MouseConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const HeldRows grip = gripOf(joint, pair);
        if (joint.hasSpring) { pushSpring(joint, pair, grip); }
        apply(grip, pair, joint.linearImpulse);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<MouseConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (MouseConstraint& joint : joints) {
        if (joint.hasSpring && !useBias) { continue; }  // drags once per sub-step
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const MouseConstraint& joint) { return {joint.linearImpulse, 0}; }

}  // namespace swept::inline SWEPT_PRECISION
