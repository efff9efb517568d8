#include "contact_constraint.h"

#include <algorithm>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A pair of states as values: read once, written once per constraint.
struct PairState {
    BodyState a;
    BodyState b;
};

void applyPair(PairState& pair, const BodyInertia& inertiaA, const BodyInertia& inertiaB,
               const ContactConstraintPoint& point, Vec2 impulse) {
    applyImpulse(pair.a, inertiaA, -impulse, point.anchorA);
    applyImpulse(pair.b, inertiaB, impulse, point.anchorB);
}

Vec2 relativeVelocity(const PairState& pair, const ContactConstraintPoint& point) {
    return velocityAt(pair.b, point.anchorB) - velocityAt(pair.a, point.anchorA);
}

void solveFriction(ContactConstraint& contact, PairState& pair, const BodyInertia& inertiaA,
                   const BodyInertia& inertiaB) {
    const Vec2 tangent = rightPerp(contact.normal);
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        const Real slip = dot(relativeVelocity(pair, point), tangent);
        const Real limit = contact.friction * point.normalImpulse;
        const Real total = std::clamp(point.tangentImpulse - point.tangentMass * slip, -limit, limit);
        applyPair(pair, inertiaA, inertiaB, point, (total - point.tangentImpulse) * tangent);
        point.tangentImpulse = total;
    }
}

/// What one point asks for now: its relative velocity along the normal to grow by `speed`, as firmly as the scales say.
struct NormalDemand {
    bool any = false;
    Real speed = 0;
    Real massScale = 1;
    Real impulseScale = 0;

    /// Of the impulse at a point, by itself.
    Real changeAt(const ContactConstraintPoint& point) const {
        return point.normalMass * massScale * speed - impulseScale * point.normalImpulse;
    }
};

/// @param isCarrying  whether a relaxation may go on with the point: it starts no contact
NormalDemand demandOf(const ContactConstraint& contact, const ContactConstraintPoint& point, const PairState& pair,
                      Real h, bool useBias, bool isCarrying) {
    const Real separation = point.separation;
    const Real closing = -dot(relativeVelocity(pair, point), contact.normal);
    // Relaxation stops nothing that is to bounce: it must arrive in the next sub-step with its speed.
    if (!useBias && closing > contact.bounceSpeed) { return {}; }
    // Its overlap or gap is the direct solver's: see `DirectSolver::project`.
    if (contact.isHeld && (point.normalImpulse > 0 || !(separation > 0))) { return {true, closing}; }
    if (separation > 0) {
        if (!useBias && !isCarrying) { return {}; }
        return {true, closing - separation / h};  // apart: may close the gap within this sub-step, no more
    }
    if (!useBias) { return {true, closing}; }
    const Real bias = std::max(contact.softness.biasRate * separation, -contact.maxPushSpeed);
    return {true, closing - bias, contact.softness.massScale, contact.softness.impulseScale};
}

/// Both points at once: the two rows, each as firm as its point asks, solved exactly, and if one of them would pull,
/// the other one alone. One after the other, the first would take all of a blow and turn the body: a box that slides
/// into a wall climbed it, and high stacks leaned, and swayed for seconds.
void solveBoth(ContactConstraint& contact, PairState& pair, const BodyInertia& inertiaA, const BodyInertia& inertiaB,
               Real h, bool useBias) {
    ContactConstraintPoint& one = contact.points[0];
    ContactConstraintPoint& two = contact.points[1];
    const bool carriesOne = one.normalImpulse > 0;
    const bool carriesTwo = two.normalImpulse > 0;
    const NormalDemand ofOne = demandOf(contact, one, pair, h, useBias, carriesOne || (contact.begins && carriesTwo));
    const NormalDemand ofTwo = demandOf(contact, two, pair, h, useBias, carriesTwo || (contact.begins && carriesOne));
    // What an impulse at the one takes from that at the other.
    const bool both = ofOne.any && ofTwo.any;
    const Real oneByTwo = both ? contact.sharedResponse * one.normalMass * ofOne.massScale : Real(0);
    const Real twoByOne = both ? contact.sharedResponse * two.normalMass * ofTwo.massScale : Real(0);
    const Real rest = 1 - oneByTwo * twoByOne;
    // What asks for nothing is pushed with nothing, as in the lanes of a block.
    const Real aloneOne = ofOne.any ? ofOne.changeAt(one) : Real(0);
    const Real aloneTwo = ofTwo.any ? ofTwo.changeAt(two) : Real(0);
    // Totals where the other one carries nothing.
    const Real onlyOne = one.normalImpulse + aloneOne + oneByTwo * two.normalImpulse;
    const Real onlyTwo = two.normalImpulse + aloneTwo + twoByOne * one.normalImpulse;
    Real totalOne = (onlyOne - oneByTwo * onlyTwo) / rest;
    Real totalTwo = (onlyTwo - twoByOne * onlyOne) / rest;
    const bool areTwo = rest > kTwoPointsRatio;  // else they are as good as one
    if (!areTwo || totalOne < 0 || totalTwo < 0) {
        const Real mostTwo = std::max(onlyTwo, Real(0));
        const bool isTwo = !(onlyOne - oneByTwo * mostTwo > 0);
        totalOne = isTwo ? Real(0) : std::max(onlyOne, Real(0));
        totalTwo = isTwo ? mostTwo : Real(0);
    }
    applyPair(pair, inertiaA, inertiaB, one, (totalOne - one.normalImpulse) * contact.normal);
    applyPair(pair, inertiaA, inertiaB, two, (totalTwo - two.normalImpulse) * contact.normal);
    one.normalImpulse = totalOne;
    two.normalImpulse = totalTwo;
}

void solveNormals(ContactConstraint& contact, PairState& pair, const BodyInertia& inertiaA, const BodyInertia& inertiaB,
                  Real h, bool useBias) {
    if (contact.count > 1) {
        solveBoth(contact, pair, inertiaA, inertiaB, h, useBias);
        return;
    }
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        const NormalDemand demand = demandOf(contact, point, pair, h, useBias, point.normalImpulse > 0);
        const Real total =
            demand.any ? std::max(point.normalImpulse + demand.changeAt(point), Real(0)) : point.normalImpulse;
        applyPair(pair, inertiaA, inertiaB, point, (total - point.normalImpulse) * contact.normal);
        point.normalImpulse = total;
    }
}

/// By how much the relative velocity of a point along the normal has to change; 0 where it does not bounce.
Real bounceAt(const ContactConstraint& contact, const ContactConstraintPoint& point, const PairState& pair, Real h) {
    const Real closing = -dot(relativeVelocity(pair, point), contact.normal);
    const bool meets = closing > contact.bounceSpeed && point.separation <= h * closing;
    return meets ? (1 + contact.restitution) * closing : Real(0);
}

/// Of the points, both at once unless one of them would pull.
std::array<Real, 2> bounceImpulses(const ContactConstraint& contact, const PairState& pair, Real h) {
    const ContactConstraintPoint& one = contact.points[0];
    const Real ofOne = bounceAt(contact, one, pair, h);
    const Real aloneOne = one.normalMass * ofOne;
    if (contact.count < 2) { return {aloneOne, 0}; }
    const ContactConstraintPoint& two = contact.points[1];
    const Real ofTwo = bounceAt(contact, two, pair, h);
    const Real aloneTwo = two.normalMass * ofTwo;
    const Real shared = ofOne > 0 && ofTwo > 0 ? contact.sharedResponse : Real(0);
    const Real oneByTwo = shared * one.normalMass;
    const Real twoByOne = shared * two.normalMass;
    const Real rest = 1 - oneByTwo * twoByOne;
    const Real leftOfOne = aloneOne - oneByTwo * aloneTwo;
    const Real leftOfTwo = aloneTwo - twoByOne * aloneOne;
    if (rest > kTwoPointsRatio && !(leftOfOne < 0) && !(leftOfTwo < 0)) { return {leftOfOne / rest, leftOfTwo / rest}; }
    return leftOfOne > 0 ? std::array<Real, 2>{aloneOne, 0} : std::array<Real, 2>{0, aloneTwo};
}

void bounce(ContactConstraint& contact, PairState& pair, const BodyInertia& inertiaA, const BodyInertia& inertiaB,
            const std::array<Real, 2>& impulses) {
    const auto count = static_cast<std::size_t>(contact.count);
    for (std::size_t i = 0; i < count; ++i) {
        ContactConstraintPoint& point = contact.points[i];
        applyPair(pair, inertiaA, inertiaB, point, impulses[i] * contact.normal);
        point.totalNormalImpulse += impulses[i];
    }
    const Vec2 tangent = rightPerp(contact.normal);
    for (std::size_t i = 0; i < count; ++i) {
        const ContactConstraintPoint& point = contact.points[i];
        const Real slip = dot(relativeVelocity(pair, point), tangent);
        const Real limit = contact.friction * impulses[i];
        applyPair(pair, inertiaA, inertiaB, point, std::clamp(-(point.tangentMass * slip), -limit, limit) * tangent);
    }
}

void findSeparations(ContactConstraint& contact, const PairState& pair) {
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        point.separation = currentSeparation(contact, point, pair.a, pair.b);
    }
}

void addUp(ContactConstraint& contact) {
    for (ContactConstraintPoint& point : contact.points) { point.totalNormalImpulse += point.normalImpulse; }
}

Real inverseOrZero(Real x) { return x > 0 ? 1 / x : Real(0); }

}  // namespace

void prepareContact(ContactConstraint& contact, std::span<const BodyInertia> inertias) {
    const BodyInertia a = inertias[contact.slotA];
    const BodyInertia b = inertias[contact.slotB];
    const Vec2 tangent = rightPerp(contact.normal);
    const Real inverseMass = a.inverseMass + b.inverseMass;
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        point.baseSeparation -= dot(point.anchorB - point.anchorA, contact.normal);
        const Real kNormal = inverseMass + a.inverseInertia * square(cross(point.anchorA, contact.normal)) +
                             b.inverseInertia * square(cross(point.anchorB, contact.normal));
        const Real kTangent = inverseMass + a.inverseInertia * square(cross(point.anchorA, tangent)) +
                              b.inverseInertia * square(cross(point.anchorB, tangent));
        point.normalMass = inverseOrZero(kNormal);
        point.tangentMass = inverseOrZero(kTangent);
    }
    if (contact.count > 1) {
        const ContactConstraintPoint& one = contact.points[0];
        const ContactConstraintPoint& two = contact.points[1];
        contact.begins = !(one.normalImpulse > 0) && !(two.normalImpulse > 0);
        contact.sharedResponse =
            inverseMass + a.inverseInertia * cross(one.anchorA, contact.normal) * cross(two.anchorA, contact.normal) +
            b.inverseInertia * cross(one.anchorB, contact.normal) * cross(two.anchorB, contact.normal);
    }
}

Real currentSeparation(const ContactConstraint& contact, const ContactConstraintPoint& point, const BodyState& a,
                       const BodyState& b) {
    const Vec2 moved = b.deltaPosition - a.deltaPosition;
    const Vec2 arms = rotate(b.deltaRotation, point.anchorB) - rotate(a.deltaRotation, point.anchorA);
    // The arms take the last stretch along the normal, of the length of a radius, with them as they turn. What is round
    // stays as high above its core as it was: or a ball that rolls would sink by r·(1 − cos) of its turn in every step.
    const Real low = contact.radiusA * (1 - a.deltaRotation.c) + contact.radiusB * (1 - b.deltaRotation.c);
    return dot(moved + arms, contact.normal) + point.baseSeparation - low;
}

void warmStartContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                       const SolverBodies& bodies) {
    for (const std::uint32_t place : places) {
        const ContactConstraint& contact = contacts[place];
        PairState pair{bodies.states[contact.slotA], bodies.states[contact.slotB]};
        const Vec2 tangent = rightPerp(contact.normal);
        for (int i = 0; i < contact.count; ++i) {
            const ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
            applyPair(pair, bodies.inertias[contact.slotA], bodies.inertias[contact.slotB], point,
                      point.normalImpulse * contact.normal + point.tangentImpulse * tangent);
        }
        storePair(bodies, contact.slotA, pair.a, contact.slotB, pair.b);
    }
}

void bounceContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                    const SolverBodies& bodies, const ContactPass& pass) {
    for (const std::uint32_t place : places) {
        ContactConstraint& contact = contacts[place];
        PairState pair{bodies.states[contact.slotA], bodies.states[contact.slotB]};
        if (pass.hasMoved) { findSeparations(contact, pair); }
        const std::array<Real, 2> impulses = bounceImpulses(contact, pair, pass.h);
        if (!(impulses[0] > 0) && !(impulses[1] > 0)) { continue; }
        bounce(contact, pair, bodies.inertias[contact.slotA], bodies.inertias[contact.slotB], impulses);
        storePair(bodies, contact.slotA, pair.a, contact.slotB, pair.b);
    }
}

void solveContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                   const SolverBodies& bodies, const ContactPass& pass) {
    for (const std::uint32_t place : places) {
        ContactConstraint& contact = contacts[place];
        PairState pair{bodies.states[contact.slotA], bodies.states[contact.slotB]};
        const BodyInertia& inertiaA = bodies.inertias[contact.slotA];
        const BodyInertia& inertiaB = bodies.inertias[contact.slotB];
        if (pass.hasMoved) { findSeparations(contact, pair); }
        solveNormals(contact, pair, inertiaA, inertiaB, pass.h, pass.useBias);
        // Friction after the normals: the limit it is held to is that of this pass.
        solveFriction(contact, pair, inertiaA, inertiaB);
        if (pass.isLast) { addUp(contact); }
        storePair(bodies, contact.slotA, pair.a, contact.slotB, pair.b);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
