#include "revolute_constraint.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool hasParts(const FreedomParts& parts) { return parts.hasSpring || parts.hasMotor || parts.hasLimits; }

Real angleOf(const RevoluteConstraint& joint, const JointPair& pair) {
    return joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
}

/// The joint as it stands in this sub-step: two points that are held together.
struct Hinge {
    Vec2 armA;
    Vec2 armB;
    PointMatrix matrix;
};

Hinge hingeOf(const RevoluteConstraint& joint, const JointPair& pair) {
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA);
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    return {armA, armB, pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB)};
}

Vec2 speedsOf(const Hinge& hinge, const JointPair& pair) {
    const Vec2 moving = pair.b.velocity - pair.a.velocity;
    return {moving.x - hinge.armB.y * pair.b.angularVelocity + hinge.armA.y * pair.a.angularVelocity,
            moving.y + hinge.armB.x * pair.b.angularVelocity - hinge.armA.x * pair.a.angularVelocity};
}

void push(RevoluteConstraint& joint, const Hinge& hinge, const JointPair& pair, Vec2 impulse) {
    pair.a.velocity -= pair.inertiaA.inverseMass * impulse;
    pair.b.velocity += pair.inertiaB.inverseMass * impulse;
    pair.a.angularVelocity += pair.inertiaA.inverseInertia * hinge.armA.y * impulse.x;
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * hinge.armA.x * impulse.y;
    pair.b.angularVelocity -= pair.inertiaB.inverseInertia * hinge.armB.y * impulse.x;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * hinge.armB.x * impulse.y;
    joint.linearImpulse += impulse;
}

/// Turns the bodies, and leaves the point to itself.
void turn(const JointPair& pair, Real impulse) {
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * impulse;
}

/// Turning while the point is held, and the point that guides it; see `GuidedRow`.
struct Spin {
    Real mass = 0;
    Vec2 answer;
    PointMatrix given;
    PointMatrix pointMatrix;
};

/// @param compliance  of the point
Spin spinOf(const Hinge& hinge, const JointPair& pair, Real compliance) {
    const Real turns = turnOf(pair);
    // Without mass to resist it the point is held by nothing: bodies that only turn.
    const bool heavy = hinge.matrix.determinant > 0;
    const Real inverse = heavy ? fullDeterminant(pair, hinge.armA, hinge.armB) / hinge.matrix.determinant : turns;
    if (!(inverse > 0)) { return {0, {}, {}, hinge.matrix}; }
    const Vec2 pull{-(pair.inertiaA.inverseInertia * hinge.armA.y + pair.inertiaB.inverseInertia * hinge.armB.y),
                    pair.inertiaA.inverseInertia * hinge.armA.x + pair.inertiaB.inverseInertia * hinge.armB.x};
    const PointMatrix given = givenBy(hinge.matrix, pull, turns, compliance);
    const PointMatrix matrix = softened(hinge.matrix, given, compliance, inverse, turns);
    return {guidedMass(compliance, inverse, turns), -solve(matrix, pull), given, matrix};
}

Vec2 gapOf(const RevoluteConstraint& joint, const Hinge& hinge, const JointPair& pair) {
    return joint.centerOffset + (pair.b.deltaPosition - pair.a.deltaPosition) + (hinge.armB - hinge.armA);
}

/// A point that guides nothing.
void solvePoint(RevoluteConstraint& joint, const Hinge& hinge, const JointPair& pair, bool useBias) {
    if (!useBias) {
        push(joint, hinge, pair, -solve(hinge.matrix, speedsOf(hinge, pair)));
        return;
    }
    if (joint.isHeld) { return; }
    const Vec2 firm = solve(hinge.matrix, speedsOf(hinge, pair) + joint.softness.biasRate * gapOf(joint, hinge, pair));
    push(joint, hinge, pair, -joint.softness.massScale * firm - joint.softness.impulseScale * joint.linearImpulse);
}

/// The point, and the angle after it, but guided: the point stays as it was just solved.
void solveParts(RevoluteConstraint& joint, const Hinge& hinge, const JointPair& pair, Real h, bool useBias) {
    const bool isSoft = useBias && !joint.isHeld;
    const Spin spin = spinOf(hinge, pair, complianceOf(joint, useBias));
    if (isSoft) {
        const Vec2 wanted = speedsOf(hinge, pair) + joint.softness.biasRate * gapOf(joint, hinge, pair);
        push(joint, hinge, pair, -solve(spin.pointMatrix, wanted + product(spin.given, joint.linearImpulse)));
    } else if (!useBias) {
        push(joint, hinge, pair, -solve(hinge.matrix, speedsOf(hinge, pair)));
    }
    solveFreedom(
        joint, spin.mass, angleOf(joint, pair), joint.softness, h, useBias,
        [&] { return pair.b.angularVelocity - pair.a.angularVelocity; },
        [&](Real impulse) {
            turn(pair, impulse);
            push(joint, hinge, pair, impulse * spin.answer);
        });
}

/// The new push of the spring, and what the point answers to its change.
void warmStartSpring(RevoluteConstraint& joint, const Hinge& hinge, const JointPair& pair) {
    const Real before = joint.springImpulse;
    const Spin spin = joint.hasSpring ? spinOf(hinge, pair, 0) : Spin{};
    pushSpring(joint, spin.mass, angleOf(joint, pair));
    joint.linearImpulse += (joint.springImpulse - before) * spin.answer;
}

void solveOne(RevoluteConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Hinge hinge = hingeOf(joint, pair);
    if (hasParts(joint)) {
        solveParts(joint, hinge, pair, h, useBias);
    } else {
        solvePoint(joint, hinge, pair, useBias);
    }
}

}  // namespace

void prepare(RevoluteConstraint& joint, std::span<const BodyInertia>) { dropUnused(joint); }

void warmStart(std::span<RevoluteConstraint> joints, const SolverBodies& bodies) {
    for (RevoluteConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Hinge hinge = hingeOf(joint, pair);
        warmStartSpring(joint, hinge, pair);
        applyImpulse(a, pair.inertiaA, -joint.linearImpulse, hinge.armA);
        applyImpulse(b, pair.inertiaB, joint.linearImpulse, hinge.armB);
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
