#include "prismatic_constraint.h"

#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The joint as it stands in this sub-step. The force on A acts where B's anchor is.
struct Slide {
    Vec2 offset;  ///< of the anchors
    Vec2 armA;
    Vec2 armB;
    JointRow along;
    HeldRows held;
};

Slide slideOf(PrismaticConstraint& joint, const JointPair& pair) {
    joint.axisNow = rotate(pair.a.deltaRotation, joint.axis);
    const Vec2 offset = anchorOffset(joint, pair.a, pair.b);
    const Vec2 armA = rotate(pair.a.deltaRotation, joint.anchorA) + offset;
    const Vec2 armB = rotate(pair.b.deltaRotation, joint.anchorB);
    return {offset, armA, armB, rowAlong(joint.axisNow, armA, armB),
            heldSlide(pair, rowAlong(leftPerp(joint.axisNow), armA, armB))};
}

bool canTurn(const JointPair& pair) { return pair.inertiaA.inverseInertia + pair.inertiaB.inverseInertia > 0; }

/// Speed along the axis per impulse, while the bodies neither turn against each other nor part.
Real inverseMassOf(const Slide& slide, const JointPair& pair) {
    return canTurn(pair) ? fullDeterminant(pair, slide.armA, slide.armB) / slide.held.matrix.determinant
                         : pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
}

void solveOne(PrismaticConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Slide slide = slideOf(joint, pair);
    const Real angle = joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle);
    const Vec2 error{cross(joint.axisNow, slide.offset), canTurn(pair) ? angle : Real(0)};
    const bool isSoft = useBias && !joint.isHeld;
    const GuidedRow along = guidedBy(slide.held, slide.along, pair, inverseMassOf(slide, pair),
                                     isSoft ? complianceOf(joint.softness) : Real(0));
    if (isSoft || !useBias) {
        solveGuiding(along, slide.held, pair, isSoft ? joint.softness.biasRate * error : Vec2{}, joint.heldImpulse);
    }
    solveFreedom(
        joint, along.mass, dot(joint.axisNow, slide.offset), joint.softness, h, useBias,
        [&] { return speedOf(along.row, pair); },
        [&](Real impulse) { apply(along, slide.held, pair, impulse, joint.heldImpulse); });
}

}  // namespace

void prepare(PrismaticConstraint& joint, std::span<const BodyInertia>) { dropUnused(joint); }

void warmStart(std::span<PrismaticConstraint> joints, const SolverBodies& bodies) {
    for (PrismaticConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const JointPair pair{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB]};
        const Slide slide = slideOf(joint, pair);
        apply(slide.held, pair, joint.heldImpulse);
        const Real inverseMass = inverseMassOf(slide, pair);
        pushSpring(joint, inverseMass > 0 ? 1 / inverseMass : Real(0), dot(joint.axisNow, slide.offset));
        apply(slide.along, pair, joint.impulse());
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
