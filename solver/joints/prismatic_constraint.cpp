#include "prismatic_constraint.h"

#include <algorithm>
#include <cmath>

#include "../wide/wide_slides.h"
#include "free_angle.h"
#include "guided_line.h"
#include "pin.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const SlideKernels* slideKernels() { return nullptr; }
#endif

namespace {

/// The joint as it stands in this sub-step. Force and torque of the joint act at B's anchor; here its rows act at a
/// point where forces do not turn the bodies against each other. So the angle has nothing to do with the rest of them,
/// however far away the anchor is.
struct Slide : GuidedLine {
    Vec2 lever;  ///< of that point, from B's anchor
    Real angle = 0;
    Real angleShare = 0;  ///< response of the angle, as far as it gives way, per compliance
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
    Slide slide{lineAlong(joint.axisNow, offset, armA + lever, armB + lever, pair), lever};
    // Errors of rows at B's anchor, there: they differ by how far the bodies have turned against each other.
    slide.angle = turn > 0 ? joint.baseAngle + (pair.b.deltaAngle - pair.a.deltaAngle) : Real(0);
    slide.place += cross(lever, slide.axis) * slide.angle;
    slide.gap += dot(lever, slide.axis) * slide.angle;
    // Of both rows: terms that are all ≥ 0, see `pointMatrix`.
    const Real mass = massOf(pair);
    const Real determinant = mass * (mass + partA * pair.inertiaB.inverseInertia * lengthSquared(armA - armB));
    slide.inverseMass = slide.response > 0 ? determinant / slide.response : Real(0);
    slide.lonely = slide.own > 0 ? determinant / slide.own : Real(0);
    const Real farther = mass + turn * lengthSquared(lever);
    slide.angleShare = farther > 0 ? turn * std::min(Real(1), kFreeAngle * mass / farther) : turn;
    return slide;
}

/// Torque that forces at the point make about B's anchor.
Real leverTorque(const PrismaticConstraint& joint, const Slide& slide) {
    return joint.impulse() * cross(slide.lever, slide.axis) + joint.heldImpulse.x * dot(slide.lever, slide.axis);
}

void solveAngle(PrismaticConstraint& joint, const Slide& slide, const JointPair& pair, Real compliance, bool useBias) {
    const Real turning = turnOf(pair);
    if (!(turning > 0)) { return; }
    const Real given = compliance * slide.angleShare;
    Real wanted = pair.b.angularVelocity - pair.a.angularVelocity;
    if (useBias) { wanted += joint.softness.biasRate * slide.angle + given * joint.heldImpulse.y; }
    const Real twist = -wanted / (turning + given);
    joint.heldImpulse.y += twist;
    turn(pair, twist);
}

void solveOne(PrismaticConstraint& joint, const JointPair& pair, Real h, bool useBias) {
    const Slide slide = slideOf(joint, pair);
    const Real compliance = complianceOf(joint, useBias);
    const Real given = compliance * slide.lonely;
    joint.heldImpulse.y -= leverTorque(joint, slide);  // what acts at the point
    if (!joint.isHeld || !useBias) { solveAngle(joint, slide, pair, compliance, useBias); }
    solveAcross(joint, joint.heldImpulse.x, slide, pair, given, useBias);
    solveAlong(joint, joint, joint.heldImpulse.x, slide, pair, given, h, useBias);
    joint.heldImpulse.y += leverTorque(joint, slide);
}

/// The side answers to the change of the spring's push, and torques go with where forces act.
void warmStartSpring(PrismaticConstraint& joint, const Slide& slide) {
    joint.heldImpulse.y -= leverTorque(joint, slide);
    joint.heldImpulse.x += warmStartSpring(joint, static_cast<const GuidedLine&>(slide));
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
        if (joint.hasSpring) { warmStartSpring(joint, slide); }
        push(pair, leftPerp(slide.axis), slide.across, joint.heldImpulse.x);
        push(pair, slide.axis, slide.along, joint.impulse());
        turn(pair, joint.heldImpulse.y - leverTorque(joint, slide));
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
