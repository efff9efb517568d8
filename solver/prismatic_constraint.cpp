#include "prismatic_constraint.h"

#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The joint as it stands in this sub-step. Force and torque of the joint act at B's anchor; here its rows act at a
/// point where forces do not turn the bodies against each other. So the angle has nothing to do with the rest of them,
/// however far away the anchor is.
struct Slide {
    Vec2 offset;  ///< of the anchors
    Vec2 lever;   ///< of that point, from B's anchor
    Real angle;
    JointRow along;
    HeldRows side;
    Real inverseMass;  ///< speed along the axis per impulse, while the bodies neither turn against each other nor part
};

Slide slideOf(PrismaticConstraint& joint, const JointPair& pair) {
    joint.axisNow = rotate(pair.a.deltaRotation, joint.axis);
    const Vec2 offset = anchorOffset(joint, pair.a, pair.b);
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA) + offset;
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    const Real turn = turnOf(pair);
    const Real partA = turn > 0 ? pair.inertiaA.inverseInertia / turn : Real(0);
    const Real partB = turn > 0 ? pair.inertiaB.inverseInertia / turn : Real(0);
    const Vec2 lever = -(partA * armA + partB * armB);
    const JointRow along = rowAlong(joint.axisNow, armA + lever, armB + lever);
    const HeldRows side = heldLine(pair, rowAlong(leftPerp(joint.axisNow), armA + lever, armB + lever));
    // Of both rows: terms that are all ≥ 0, see `pointMatrix`.
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real determinant = mass * (mass + partA * pair.inertiaB.inverseInertia * lengthSquared(armA - armB));
    const Real across = side.matrix.xx;
    return {offset, lever, turn > 0 ? joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle) : Real(0),
            along,  side,  across > 0 ? determinant / across : Real(0)};
}

/// Errors of rows at B's anchor, there: they differ by how far the bodies have turned against each other.
Real errorAt(const Slide& slide, Vec2 direction) {
    return dot(direction, slide.offset) + cross(slide.lever, direction) * slide.angle;
}

/// Torque that forces at the point make about B's anchor.
Real leverTorque(const PrismaticConstraint& joint, const Slide& slide) {
    return cross(slide.lever, joint.impulse() * joint.axisNow + joint.heldImpulse.x * leftPerp(joint.axisNow));
}

/// The angle gives way by no more than what moves the anchor as far as its softness across the axis does.
/// @param compliance  of what is held
void solveAngle(PrismaticConstraint& joint, const Slide& slide, const JointPair& pair, Real compliance, bool useBias) {
    const Real turn = turnOf(pair);
    if (!(turn > 0)) { return; }
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real farther = turn * lengthSquared(slide.lever);
    const Real part = mass + farther > 0 ? mass / (mass + farther) : Real(1);
    const Real given = compliance * turn * part;
    const Real bias = useBias ? joint.softness.biasRate * slide.angle : Real(0);
    const Real twist = -(speedOf(kSpinRow, pair) + bias + given * joint.heldImpulse.y) / (turn + given);
    joint.heldImpulse.y += twist;
    apply(kSpinRow, pair, twist);
}

/// The angle, side and way of one pass. @pre `heldImpulse.y` is the torque at the point
void solveAtPoint(PrismaticConstraint& joint, const Slide& slide, const JointPair& pair, Real h, bool useBias) {
    const Real compliance = complianceOf(joint, useBias);
    const GuidedRow along = guidedBy(slide.side, slide.along, pair, slide.inverseMass, compliance);
    Vec2 side{joint.heldImpulse.x, 0};
    if (!joint.isHeld || !useBias) {
        solveAngle(joint, slide, pair, compliance, useBias);
        const Real error = errorAt(slide, leftPerp(joint.axisNow));
        solveGuiding(along, slide.side, pair, {useBias ? joint.softness.biasRate * error : Real(0), 0}, side);
    }
    solveFreedom(
        joint, along.mass, errorAt(slide, joint.axisNow), joint.softness, h, useBias,
        [&] { return speedOf(along.row, pair); }, [&](Real push) { apply(along, slide.side, pair, push, side); });
    joint.heldImpulse.x = side.x;
}

void solveOne(PrismaticConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Slide slide = slideOf(joint, pair);
    joint.heldImpulse.y -= leverTorque(joint, slide);
    solveAtPoint(joint, slide, pair, h, useBias);
    joint.heldImpulse.y += leverTorque(joint, slide);
}

}  // namespace

void prepare(PrismaticConstraint& joint, std::span<const BodyInertia>) { dropUnused(joint); }

void warmStart(std::span<PrismaticConstraint> joints, const SolverBodies& bodies) {
    for (PrismaticConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Slide slide = slideOf(joint, pair);
        // The side answers to the change of the spring's push, and torques go with where forces act.
        const Real before = joint.springImpulse;
        pushSpring(joint, slide.inverseMass > 0 ? 1 / slide.inverseMass : Real(0), errorAt(slide, joint.axisNow));
        const Real change = joint.springImpulse - before;
        const Real side = change * guidedBy(slide.side, slide.along, pair, slide.inverseMass, 0).answer.x;
        joint.heldImpulse.x += side;
        joint.heldImpulse.y += cross(slide.lever, change * joint.axisNow + side * leftPerp(joint.axisNow));
        apply(slide.side.first, pair, joint.heldImpulse.x);
        apply(slide.along, pair, joint.impulse());
        apply(kSpinRow, pair, joint.heldImpulse.y - leverTorque(joint, slide));
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<PrismaticConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (PrismaticConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        solveOne(joint, {a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]}, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const PrismaticConstraint& joint) {
    return {joint.impulse() * joint.axisNow + joint.heldImpulse.x * leftPerp(joint.axisNow), joint.heldImpulse.y};
}

Real axisGap(const PrismaticConstraint& joint, const BodyState& a, const BodyState& b) {
    return std::fabs(cross(rotate(a.deltaRotation, joint.axis), anchorOffset(joint, a, b)));
}

}  // namespace swept::inline SWEPT_PRECISION
