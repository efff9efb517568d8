#include "wheel_constraint.h"

#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The joint as it stands in this sub-step. The force on A acts where B's anchor is.
struct Axle {
    Vec2 offset;  ///< of the anchors
    Vec2 armA;
    Vec2 armB;
    JointRow along;
    HeldRows held;
};

Axle axleOf(WheelConstraint& joint, const JointPair& pair) {
    joint.axisNow = rotate(pair.a.deltaRotation, joint.axis);
    const Vec2 offset = anchorOffset(joint, pair.a, pair.b);
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA) + offset;
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    return {offset, armA, armB, rowAlong(joint.axisNow, armA, armB),
            heldLine(pair, rowAlong(leftPerp(joint.axisNow), armA, armB))};
}

/// Speed along the axis per impulse, while nothing moves across it; 0 when nothing can move.
Real inverseMassOf(const Axle& axle, const JointPair& pair) {
    const Real across = axle.held.matrix.xx;
    if (!(across > 0)) { return 0; }
    return pointMatrix(pair.inertiaA, axle.armA, pair.inertiaB, axle.armB).determinant / across;
}

bool isDriven(const WheelConstraint& joint, const JointPair& pair) { return joint.hasMotor && turnOf(pair) > 0; }
bool isSprung(const WheelConstraint& joint) { return joint.suspension.hasSpring || joint.suspension.hasLimits; }

/// Response across the axis while all that it guides is held, too: a Schur complement, as a quotient of determinants.
Real lonelyResponse(const WheelConstraint& joint, const Axle& axle, const JointPair& pair) {
    const Real along = coupling(axle.along, axle.along, pair);
    if (!(along > 0)) { return axle.held.matrix.xx; }
    if (isDriven(joint, pair) && isSprung(joint)) {
        const Real rest = heldSlide(pair, axle.along).matrix.determinant;
        return rest > 0 ? fullDeterminant(pair, axle.armA, axle.armB) / rest : axle.held.matrix.xx;
    }
    if (isDriven(joint, pair)) { return heldSlide(pair, axle.held.first).matrix.determinant / turnOf(pair); }
    if (isSprung(joint)) { return pointMatrix(pair.inertiaA, axle.armA, pair.inertiaB, axle.armB).determinant / along; }
    return axle.held.matrix.xx;
}

/// @param given  see `guidedByLine`
void solveAcross(WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real given, bool useBias) {
    const Real across = axle.held.matrix.xx + given;
    if ((joint.isHeld && useBias) || !(across > 0)) { return; }
    const Real bias = useBias ? joint.softness.biasRate * cross(joint.axisNow, axle.offset) : Real(0);
    const Real change = -(speedOf(axle.held.first, pair) + bias + given * joint.heldImpulse.x) / across;
    joint.heldImpulse.x += change;
    apply(axle.held.first, pair, change);
}

void driveSpin(WheelConstraint& joint, const Axle& axle, const JointPair& pair, Real given) {
    const Real across = axle.held.matrix.xx;
    const Real inverse = across > 0 ? heldSlide(pair, axle.held.first).matrix.determinant / across : turnOf(pair);
    const GuidedRow spin = guidedByLine(axle.held, kSpinRow, pair, inverse, given);
    const Real change =
        motorChange(spin.mass, speedOf(kSpinRow, pair), joint.motorSpeed, joint.motorImpulse, joint.maxMotorImpulse);
    joint.motorImpulse += change;
    apply(spin, axle.held, pair, change, joint.heldImpulse);
}

/// The new push of the spring, and what is held answers to its change.
void warmStartSpring(WheelConstraint& joint, const Axle& axle, const JointPair& pair) {
    const Real before = joint.suspension.springImpulse;
    const GuidedRow along = guidedByLine(axle.held, axle.along, pair, inverseMassOf(axle, pair), 0);
    pushSpring(joint.suspension, along.mass, dot(joint.axisNow, axle.offset));
    joint.heldImpulse += (joint.suspension.springImpulse - before) * along.answer;
}

void solveOne(WheelConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Axle axle = axleOf(joint, pair);
    const Real compliance = complianceOf(joint, useBias);
    const Real given = compliance > 0 ? compliance * lonelyResponse(joint, axle, pair) : Real(0);
    solveAcross(joint, axle, pair, given, useBias);
    if (isDriven(joint, pair)) { driveSpin(joint, axle, pair, given); }
    if (!isSprung(joint)) { return; }
    const GuidedRow along = guidedByLine(axle.held, axle.along, pair, inverseMassOf(axle, pair), given);
    solveFreedom(
        joint.suspension, along.mass, dot(joint.axisNow, axle.offset), joint.softness, h, useBias,
        [&] { return speedOf(along.row, pair); },
        [&](Real impulse) { apply(along, axle.held, pair, impulse, joint.heldImpulse); });
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
        warmStartSpring(joint, axle, pair);
        apply(axle.held, pair, joint.heldImpulse);
        apply(axle.along, pair, joint.suspension.impulse());
        apply(kSpinRow, pair, joint.motorImpulse);
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
