#include "distance_constraint.h"

#include <algorithm>
#include <cmath>

#include "../wide/wide_rods.h"
#include "freedom_parts.h"
#include "joint_rows.h"

namespace swept::inline SWEPT_PRECISION {

#ifndef SWEPT_SIMD
const RodKernels* rodKernels() { return nullptr; }
#endif

namespace {

/// The joint as it stands in this sub-step.
struct Rod {
    BodyState& a;
    BodyState& b;
    const BodyInertia& inertiaA;
    const BodyInertia& inertiaB;
    Vec2 armA;
    Vec2 armB;
    Vec2 axis;
    Real length;
    Real response;
    Real mass;

    Real speed() const { return dot(axis, velocityAt(b, armB) - velocityAt(a, armA)); }
    void apply(Real impulse) const {
        applyImpulse(a, inertiaA, -impulse * axis, armA);
        applyImpulse(b, inertiaB, impulse * axis, armB);
    }
};

Rod rodOf(DistanceConstraint& joint, BodyState& a, BodyState& b, const SolverBodies& bodies) {
    const UnitAndLength offset = normalized(anchorOffset(joint, a, b));
    if (offset.length > 0) { joint.axis = offset.unit; }
    Rod rod{a,
            b,
            bodies.inertias[joint.slotA],
            bodies.inertias[joint.slotB],
            rotate(a.deltaRotation, joint.anchorA),
            rotate(b.deltaRotation, joint.anchorB),
            joint.axis,
            offset.length,
            0,
            0};
    rod.response = rod.inertiaA.inverseMass + rod.inertiaB.inverseMass +
                   rod.inertiaA.inverseInertia * square(cross(rod.armA, rod.axis)) +
                   rod.inertiaB.inverseInertia * square(cross(rod.armB, rod.axis));
    rod.mass = rod.response > 0 ? 1 / rod.response : Real(0);
    return rod;
}

SpringGains gainsOf(const DistanceConstraint& joint, const Rod& rod) {
    return gainsAt(joint.spring, phaseSquaredAt(joint.spring, rod.response));
}

/// What holds its length. @tparam kGlide  length and limits move
template <bool kGlide>
void solveHeld(DistanceConstraint& joint, const Rod& rod, Real h, bool useBias) {
    const LimitPace asked = kGlide ? joint.motion.asked(useBias) : LimitPace{};
    if (joint.isRigid && !(joint.isHeld && useBias)) {
        const Real error = useBias ? rod.length - joint.length : Real(0);
        const Real change = scalarChange(rod.mass, rod.speed() - asked.lower, error, joint.rigidImpulse,
                                         useBias ? joint.softness : kRigid);
        joint.rigidImpulse += change;
        rod.apply(change);
    }
    if (!joint.hasLimits) { return; }
    const JointPass pass = passOf(joint, h, useBias);
    const Real lower =
        limitChange(pass, rod.mass, rod.speed() - asked.lower, rod.length - joint.minLength, joint.lowerImpulse);
    joint.lowerImpulse += lower;
    rod.apply(lower);
    const Real upper =
        limitChange(pass, rod.mass, -(rod.speed() - asked.upper), joint.maxLength - rod.length, joint.upperImpulse);
    joint.upperImpulse += upper;
    rod.apply(-upper);
}

void solveOne(DistanceConstraint& joint, const Rod& rod, Real h, bool useBias) {
    if (!(rod.mass > 0)) { return; }   // nothing to move; and 0 kg times the room of a limit at infinity is no number
    if (joint.hasSpring && useBias) {  // once per sub-step
        const Real change = dragChange(gainsOf(joint, rod), joint.springImpulse, rod.mass * rod.speed());
        joint.springImpulse += change;
        rod.apply(change);
    }
    if (joint.isGliding) [[unlikely]] {
        solveHeld<true>(joint, rod, h, useBias);
    } else {
        solveHeld<false>(joint, rod, h, useBias);
    }
}

}  // namespace

void prepare(DistanceConstraint& joint, std::span<const BodyInertia>) {
    if (!joint.isRigid) { joint.rigidImpulse = 0; }
    if (!joint.hasLimits) { joint.lowerImpulse = joint.upperImpulse = 0; }
}

void warmStart(std::span<DistanceConstraint> joints, const SolverBodies& bodies) {
    for (DistanceConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const Rod rod = rodOf(joint, a, b, bodies);
        const Real stretch = rod.length - joint.length;
        joint.springImpulse = joint.hasSpring ? -rod.mass * (gainsOf(joint, rod).push * stretch) : Real(0);
        rod.apply(joint.impulse());
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solve(std::span<DistanceConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (DistanceConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const Rod rod = rodOf(joint, a, b, bodies);
        solveOne(joint, rod, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

JointReaction reactionOf(const DistanceConstraint& joint) { return {joint.impulse() * joint.axis, 0}; }

Real lengthError(const DistanceConstraint& joint, const BodyState& a, const BodyState& b) {
    const Real length = normalized(anchorOffset(joint, a, b)).length;
    Real error = 0;
    if (joint.isRigid) { error = std::fabs(length - joint.length); }
    if (joint.hasLimits) { error = std::max({error, joint.minLength - length, length - joint.maxLength}); }
    return error;
}

}  // namespace swept::inline SWEPT_PRECISION
