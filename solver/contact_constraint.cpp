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

void solveNormals(ContactConstraint& contact, PairState& pair, const BodyInertia& inertiaA,
                  const BodyInertia& inertiaB, Real h, bool useBias) {
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        const Real separation = currentSeparation(contact, point, pair.a, pair.b);
        const Real closing = -dot(relativeVelocity(pair, point), contact.normal);
        // Relaxation stops nothing that is to bounce: it must arrive in the next sub-step with its speed.
        if (!useBias && closing > contact.bounceSpeed) { continue; }
        Real bias = 0;
        Real massScale = 1;
        Real impulseScale = 0;
        if (separation > 0) {
            if (!useBias && !(point.normalImpulse > 0)) { continue; }  // relaxation starts no contact
            bias = separation / h;  // apart: may close the gap within this sub-step, no more
        } else if (useBias) {
            bias = std::max(contact.softness.biasRate * separation, -contact.maxPushSpeed);
            massScale = contact.softness.massScale;
            impulseScale = contact.softness.impulseScale;
        }
        const Real change = point.normalMass * massScale * (closing - bias) - impulseScale * point.normalImpulse;
        const Real total = std::max(point.normalImpulse + change, Real(0));
        applyPair(pair, inertiaA, inertiaB, point, (total - point.normalImpulse) * contact.normal);
        point.normalImpulse = total;
    }
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
}

Real currentSeparation(const ContactConstraint& contact, const ContactConstraintPoint& point, const BodyState& a,
                       const BodyState& b) {
    const Vec2 moved = b.deltaPosition - a.deltaPosition;
    const Vec2 arms = rotate(b.deltaRotation, point.anchorB) - rotate(a.deltaRotation, point.anchorA);
    return dot(moved + arms, contact.normal) + point.baseSeparation;
}

void warmStartContacts(std::span<ContactConstraint> contacts, const SolverBodies& bodies) {
    for (ContactConstraint& contact : contacts) {
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

void solveContacts(std::span<ContactConstraint> contacts, const SolverBodies& bodies, Real h, bool useBias) {
    for (ContactConstraint& contact : contacts) {
        PairState pair{bodies.states[contact.slotA], bodies.states[contact.slotB]};
        const BodyInertia& inertiaA = bodies.inertias[contact.slotA];
        const BodyInertia& inertiaB = bodies.inertias[contact.slotB];
        solveNormals(contact, pair, inertiaA, inertiaB, h, useBias);
        // Friction after the normals: the limit it is held to is that of this pass.
        solveFriction(contact, pair, inertiaA, inertiaB);
        storePair(bodies, contact.slotA, pair.a, contact.slotB, pair.b);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
