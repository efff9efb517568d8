#include "distance_constraint.h"

#include <algorithm>
#include <cmath>

#include "point_constraint.h"

namespace swept::inline SWEPT_PRECISION {
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
    Real mass;

    Real speed() const { return dot(axis, velocityAt(b, armB) - velocityAt(a, armA)); }
    void apply(Real impulse) const {
        applyImpulse(a, inertiaA, -impulse * axis, armA);
        applyImpulse(b, inertiaB, impulse * axis, armB);
    }
};

Vec2 anchorOffset(const DistanceConstraint& joint, const BodyState& a, const BodyState& b) {
    return joint.centerOffset + (b.deltaPosition - a.deltaPosition) + rotate(b.deltaRotation, joint.anchorB) -
           rotate(a.deltaRotation, joint.anchorA);
}

Rod rodOf(DistanceConstraint& joint, BodyState& a, BodyState& b, const SolverBodies& bodies) {
    const UnitAndLength offset = normalized(anchorOffset(joint, a, b));
    if (offset.length > 0) { joint.axis = offset.unit; }
    Rod rod{a, b, bodies.inertias[joint.slotA], bodies.inertias[joint.slotB], rotate(a.deltaRotation, joint.anchorA),
            rotate(b.deltaRotation, joint.anchorB), joint.axis, offset.length, 0};
    const Real inverse = rod.inertiaA.inverseMass + rod.inertiaB.inverseMass +
                         rod.inertiaA.inverseInertia * square(cross(rod.armA, rod.axis)) +
                         rod.inertiaB.inverseInertia * square(cross(rod.armB, rod.axis));
    rod.mass = inverse > 0 ? 1 / inverse : Real(0);
    return rod;
}

/// One side of the limits. @param room  length left, negative beyond; @param direction  +1 lower, −1 upper limit
void solveLimit(const Rod& rod, Real room, Real direction, const Softness& softness, Real& accumulated, Real h,
                bool useBias) {
    const Real speed = direction * rod.speed();
    Real change = 0;
    if (room > 0) {
        change = -rod.mass * (speed + room / h);
    } else {
        change = scalarChange(rod.mass, speed, useBias ? room : Real(0), accumulated, useBias ? softness : kRigid);
    }
    const Real total = std::max(accumulated + change, Real(0));
    rod.apply(direction * (total - accumulated));
    accumulated = total;
}

void solveOne(DistanceConstraint& joint, const Rod& rod, Real h, bool useBias) {
    if (!(rod.mass > 0)) { return; }  // nothing to move; and 0 kg times the room of a limit at infinity is no number
    // Once per sub-step: solved again in relaxation, with the length that it has just made, the spring would damp twice.
    if (joint.hasSpring && useBias) {
        const Real change = scalarChange(rod.mass, rod.speed(), rod.length - joint.length, joint.springImpulse,
                                         joint.spring);
        joint.springImpulse += change;
        rod.apply(change);
    }
    if (joint.isRigid) {
        const Real error = useBias ? rod.length - joint.length : Real(0);
        const Real change =
            scalarChange(rod.mass, rod.speed(), error, joint.rigidImpulse, useBias ? joint.softness : kRigid);
        joint.rigidImpulse += change;
        rod.apply(change);
    }
    if (joint.hasLimits) {
        solveLimit(rod, rod.length - joint.minLength, 1, joint.softness, joint.lowerImpulse, h, useBias);
        solveLimit(rod, joint.maxLength - rod.length, -1, joint.softness, joint.upperImpulse, h, useBias);
    }
}

}  // namespace

void prepareDistance(DistanceConstraint& joint) {
    if (!joint.hasSpring) { joint.springImpulse = 0; }
    if (!joint.isRigid) { joint.rigidImpulse = 0; }
    if (!joint.hasLimits) { joint.lowerImpulse = joint.upperImpulse = 0; }
}

void warmStartDistances(std::span<DistanceConstraint> joints, const SolverBodies& bodies) {
    for (DistanceConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        rodOf(joint, a, b, bodies)
            .apply(joint.rigidImpulse + joint.springImpulse + joint.lowerImpulse - joint.upperImpulse);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

void solveDistances(std::span<DistanceConstraint> joints, const SolverBodies& bodies, Real h, bool useBias) {
    for (DistanceConstraint& joint : joints) {
        BodyState a = bodies.states[joint.slotA];
        BodyState b = bodies.states[joint.slotB];
        const Rod rod = rodOf(joint, a, b, bodies);
        solveOne(joint, rod, h, useBias);
        storePair(bodies, joint.slotA, a, joint.slotB, b);
    }
}

Real lengthError(const DistanceConstraint& joint, const BodyState& a, const BodyState& b) {
    const Real length = normalized(anchorOffset(joint, a, b)).length;
    Real error = 0;
    if (joint.isRigid) { error = std::fabs(length - joint.length); }
    if (joint.hasLimits) { error = std::max({error, joint.minLength - length, length - joint.maxLength}); }
    return error;
}

}  // namespace swept::inline SWEPT_PRECISION
