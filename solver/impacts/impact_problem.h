#pragma once

#include <array>
#include <cmath>

#include "impact.h"

/// An impact of one contact as impact.cpp and reflect_impacts.cpp look at it.

namespace swept::inline SWEPT_PRECISION {

/// An approach below this share of the points' own speeds is what rounding leaves of a solved contact.
inline constexpr Real kRoundingRatio = 8 * kEpsilon;
using Scalars = std::array<Real, 2>;  ///< by point

/// An impact as a small linear problem: how the relative velocities of the points answer to impulses at them.
struct ImpactProblem {
    const ContactConstraint& contact;
    BodyState a;
    BodyState b;
    BodyInertia inertiaA;
    BodyInertia inertiaB;
    std::array<bool, 2> active{};

    const ContactConstraintPoint& point(int i) const { return contact.points[static_cast<std::size_t>(i)]; }

    Vec2 relativeVelocity(int i) const { return velocityAt(b, point(i).anchorB) - velocityAt(a, point(i).anchorA); }
    /// Of the surfaces on each other, along the tangent.
    Real slip(int i) const { return dot(relativeVelocity(i), rightPerp(contact.normal)) - contact.surfaceSpeed; }
    /// What rounding of the relative velocity is measured against: sum of the speeds it is made of. Those of moving and
    /// turning are taken apart, since they cancel where a body rolls, and their rounding does not.
    Real speedScale(int i) const {
        return length(a.velocity) + std::fabs(a.angularVelocity) * length(point(i).anchorA) + length(b.velocity) +
               std::fabs(b.angularVelocity) * length(point(i).anchorB);
    }
    void apply(int i, Vec2 impulse) {
        applyImpulse(a, inertiaA, -impulse, point(i).anchorA);
        applyImpulse(b, inertiaB, impulse, point(i).anchorB);
    }
    /// Normal velocity at point i for a unit normal impulse at point j.
    Real response(int i, int j) const {
        const Vec2 n = contact.normal;
        return inertiaA.inverseMass + inertiaB.inverseMass +
               inertiaA.inverseInertia * cross(point(i).anchorA, n) * cross(point(j).anchorA, n) +
               inertiaB.inverseInertia * cross(point(i).anchorB, n) * cross(point(j).anchorB, n);
    }
    /// Tangential velocity at point i for a unit normal impulse there, and the other way round.
    Real coupling(int i, Vec2 tangent) const {
        const Vec2 n = contact.normal;
        return inertiaA.inverseInertia * cross(point(i).anchorA, n) * cross(point(i).anchorA, tangent) +
               inertiaB.inverseInertia * cross(point(i).anchorB, n) * cross(point(i).anchorB, tangent);
    }
};

/// Which points take part in an impact, and how.
struct Approach {
    Scalars speed{};  ///< m/s; of points that take no part, too
    Scalars scale{};  ///< what its rounding is measured against, m/s: `ImpactProblem::speedScale`
    Scalars restitution{};
    std::array<bool, 2> active{};

    bool any() const { return active[0] || active[1]; }
};

inline Approach approachOf(const ImpactProblem& problem, const ImpactRule& rule) {
    const ContactConstraint& contact = problem.contact;
    Approach approach;
    for (int i = 0; i < contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real speed = -dot(problem.relativeVelocity(i), contact.normal);
        approach.speed[k] = speed;
        approach.scale[k] = problem.speedScale(i);
        if (contact.points[k].normalMass <= 0 || speed <= kRoundingRatio * approach.scale[k]) { continue; }
        const bool bounces = contact.restitution > 0 && speed > rule.restitutionThreshold;
        const bool meets = rule.horizon <= 0 ||
                           currentSeparation(contact, contact.points[k], problem.a, problem.b) <= speed * rule.horizon;
        approach.active[k] = meets && (bounces || rule.resolvePlastic);
        approach.restitution[k] = bounces ? contact.restitution : Real(0);
    }
    return approach;
}

inline ImpactProblem problemOf(const ContactConstraint& contact, const SolverBodies& bodies) {
    return {contact, bodies.states[contact.slotA], bodies.states[contact.slotB], bodies.inertias[contact.slotA],
            bodies.inertias[contact.slotB]};
}

}  // namespace swept::inline SWEPT_PRECISION
