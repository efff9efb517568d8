#pragma once

#include <array>
#include <cmath>

#include "impact.h"

/// An impact of one contact as impact.cpp and reflect_impacts.cpp look at it.

namespace swept::inline SWEPT_PRECISION {

/// An approach below this share of the points' own speeds is what rounding leaves of a solved contact.
inline constexpr Real kRoundingRatio = 8 * kEpsilon;
using Scalars = std::array<Real, 2>;  ///< by point

inline bool isAnyHeld(const ContactConstraint& contact) { return contact.answerA.isHeld || contact.answerB.isHeld; }

/// How bodies answer to impulses at the points of their contact: freely, or as joints let them.
struct BlowPair {
    const ContactConstraint& contact;
    const BodyInertia& a;
    const BodyInertia& b;

    const ContactConstraintPoint& point(int i) const { return contact.points[static_cast<std::size_t>(i)]; }

    /// Impulse on B at a point; its opposite on A.
    void apply(int i, Vec2 impulse, BodyState& stateA, BodyState& stateB) const {
        push(stateA, a, contact.answerA, -impulse, point(i).anchorA);
        push(stateB, b, contact.answerB, impulse, point(i).anchorB);
    }
    /// Normal velocity at point i for a unit normal impulse at point j.
    Real response(int i, int j) const {
        if (!isAnyHeld(contact)) {
            return a.inverseMass + b.inverseMass + a.inverseInertia * point(i).normalArmA * point(j).normalArmA +
                   b.inverseInertia * point(i).normalArmB * point(j).normalArmB;
        }
        const Vec2 normal = contact.normal;
        return answer(a, contact.answerA, {normal, point(i).normalArmA}, {normal, point(j).normalArmA}) +
               answer(b, contact.answerB, {normal, point(i).normalArmB}, {normal, point(j).normalArmB});
    }
    /// Tangential velocity at point i for a unit normal impulse there, and the other way round.
    Real coupling(int i) const {
        const Vec2 normal = contact.normal;
        const Vec2 tangent = rightPerp(normal);
        return coupled(a, contact.answerA, {normal, point(i).normalArmA}, {tangent, point(i).tangentArmA}) +
               coupled(b, contact.answerB, {normal, point(i).normalArmB}, {tangent, point(i).tangentArmB});
    }
    /// Of the answers to impulses at a point itself: those that were prepared, unless joints hold a body.
    Real normalMass(int i) const {
        if (!isAnyHeld(contact)) { return point(i).normalMass; }
        return heldMass({contact.normal, point(i).normalArmA}, {contact.normal, point(i).normalArmB});
    }
    Real tangentMass(int i) const {
        if (!isAnyHeld(contact)) { return point(i).tangentMass; }
        const Vec2 tangent = rightPerp(contact.normal);
        return heldMass({tangent, point(i).tangentArmA}, {tangent, point(i).tangentArmB});
    }

private:
    /// Of what a body would yield without its joints: what is left of less than that is held. A blow at an eighth of
    /// its length from a hinge would turn it away at eight times the speed, and one at the hinge at any speed.
    static constexpr Real kAllButHeld = Real(1) / 64;

    /// Of an impulse, and its lever.
    struct Row {
        Vec2 along;
        Real arm = 0;
    };

    static Real freeAnswer(const BodyInertia& body, const Row& i, const Row& j) {
        return body.inverseMass + body.inverseInertia * i.arm * j.arm;
    }
    /// Of rows along one direction.
    static Real answer(const BodyInertia& body, const BlowAnswer& held, const Row& i, const Row& j) {
        return held.isHeld ? held.along(i.along, i.arm, j.along, j.arm) : freeAnswer(body, i, j);
    }
    static Real coupled(const BodyInertia& body, const BlowAnswer& held, const Row& normal, const Row& tangent) {
        return held.isHeld ? held.along(tangent.along, tangent.arm, normal.along, normal.arm)
                           : body.inverseInertia * normal.arm * tangent.arm;
    }
    static bool yields(const BodyInertia& body, const BlowAnswer& held, const Row& row) {
        const Real free = freeAnswer(body, row, row);
        return held.isHeld ? answer(body, held, row, row) > kAllButHeld * free : free > 0;
    }
    /// 0: nothing yields.
    Real heldMass(const Row& ofA, const Row& ofB) const {
        if (!yields(a, contact.answerA, ofA) && !yields(b, contact.answerB, ofB)) { return 0; }
        return 1 / (answer(a, contact.answerA, ofA, ofA) + answer(b, contact.answerB, ofB, ofB));
    }
    /// @param own  the impulse on the body
    static void push(BodyState& state, const BodyInertia& inertia, const BlowAnswer& held, Vec2 own, Vec2 anchor) {
        if (!held.isHeld) {
            if (isMovable(inertia)) { applyImpulse(state, inertia, own, anchor); }
            return;
        }
        const Real twist = cross(anchor, own);
        state.velocity += held.velocity(own, twist);
        state.angularVelocity += held.spin(own, twist);
    }
};

/// An impact as a small linear problem: how the relative velocities of the points answer to impulses at them.
struct ImpactProblem {
    BlowPair blow;
    BodyState a;
    BodyState b;
    std::array<bool, 2> active{};

    const ContactConstraint& contact() const { return blow.contact; }
    const ContactConstraintPoint& point(int i) const { return blow.point(i); }

    Vec2 relativeVelocity(int i) const { return velocityAt(b, point(i).anchorB) - velocityAt(a, point(i).anchorA); }
    /// Of the surfaces on each other, along the tangent.
    Real slip(int i) const { return dot(relativeVelocity(i), rightPerp(contact().normal)) - contact().surfaceSpeed; }
    /// What rounding of the relative velocity is measured against: sum of the speeds it is made of. Those of moving and
    /// turning are taken apart, since they cancel where a body rolls, and their rounding does not.
    Real speedScale(int i) const {
        return length(a.velocity) + std::fabs(a.angularVelocity) * length(point(i).anchorA) + length(b.velocity) +
               std::fabs(b.angularVelocity) * length(point(i).anchorB);
    }
    void apply(int i, Vec2 impulse) { blow.apply(i, impulse, a, b); }
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
    const ContactConstraint& contact = problem.contact();
    Approach approach;
    for (int i = 0; i < contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real speed = -dot(problem.relativeVelocity(i), contact.normal);
        approach.speed[k] = speed;
        approach.scale[k] = problem.speedScale(i);
        if (problem.blow.normalMass(i) <= 0 || speed <= kRoundingRatio * approach.scale[k]) { continue; }
        const bool bounces = contact.restitution > 0 && speed > rule.restitutionThreshold;
        const bool meets = rule.horizon <= 0 ||
                           currentSeparation(contact, contact.points[k], problem.a, problem.b) <= speed * rule.horizon;
        approach.active[k] = meets && (bounces || rule.resolvePlastic);
        approach.restitution[k] = bounces ? contact.restitution : Real(0);
    }
    return approach;
}

inline BlowPair blowPairOf(const ContactConstraint& contact, const SolverBodies& bodies) {
    return {contact, bodies.inertias[contact.slotA], bodies.inertias[contact.slotB]};
}
inline ImpactProblem problemOf(const ContactConstraint& contact, const SolverBodies& bodies) {
    return {blowPairOf(contact, bodies), bodies.states[contact.slotA], bodies.states[contact.slotB]};
}

}  // namespace swept::inline SWEPT_PRECISION
