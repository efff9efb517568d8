#include "impact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Below this ratio of the determinant to the product of its diagonal, two points act as one (same place, or no rotation).
constexpr Real kSingularRatio = 16 * kEpsilon;
/// An approach below this share of the points' own speeds is what rounding leaves of a solved contact.
constexpr Real kRoundingRatio = 8 * kEpsilon;
/// Impulse vectors (world) at the points.
using Impulses = std::array<Vec2, 2>;
using Scalars = std::array<Real, 2>;

/// An impact as a small linear problem: how the relative velocities of the points answer to impulses at them.
struct ImpactProblem {
    const ContactConstraint& contact;
    BodyState a;
    BodyState b;
    BodyInertia inertiaA;
    BodyInertia inertiaB;
    std::array<bool, 2> active{};

    const ContactConstraintPoint& point(int i) const { return contact.points[static_cast<std::size_t>(i)]; }

    Vec2 relativeVelocity(int i) const {
        return velocityAt(b, point(i).anchorB) - velocityAt(a, point(i).anchorA);
    }
    /// Sum of the points' own speeds: what rounding of the relative velocity is measured against.
    Real speedScale(int i) const {
        return length(velocityAt(a, point(i).anchorA)) + length(velocityAt(b, point(i).anchorB));
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
};

/// Smallest non-negative impulses that change both normal velocities by `change` (both points approach).
Scalars solveBlock(const ImpactProblem& problem, const Scalars& change) {
    const Real k00 = problem.response(0, 0);
    const Real k11 = problem.response(1, 1);
    const Real k01 = problem.response(0, 1);
    const Real determinant = k00 * k11 - k01 * k01;
    if (determinant <= kSingularRatio * k00 * k11) {
        const Real each = std::max(change[0], change[1]) / (k00 + k11);
        return {each, each};
    }
    const Real x0 = (change[0] * k11 - change[1] * k01) / determinant;
    const Real x1 = (change[1] * k00 - change[0] * k01) / determinant;
    if (x0 >= 0 && x1 >= 0) { return {x0, x1}; }
    // One point alone carries the impact and lifts the other at least as much as asked.
    return x0 < 0 ? Scalars{0, change[1] / k11} : Scalars{change[0] / k00, 0};
}

/// Impulses for given restitutions of the points: normals together, then friction point by point.
Impulses impulsesFor(ImpactProblem problem, const Scalars& restitution) {
    const Vec2 normal = problem.contact.normal;
    const Vec2 tangent = rightPerp(normal);
    Scalars change{};
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (problem.active[k]) { change[k] = -(1 + restitution[k]) * dot(problem.relativeVelocity(i), normal); }
    }
    Scalars normalImpulse{};
    if (problem.active[0] && problem.active[1]) {
        normalImpulse = solveBlock(problem, change);
    } else {
        const std::size_t only = problem.active[0] ? 0 : 1;
        normalImpulse[only] = change[only] * problem.point(static_cast<int>(only)).normalMass;
    }
    Impulses impulses{};
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        impulses[k] = normalImpulse[k] * normal;
        problem.apply(i, impulses[k]);
    }
    for (int i = 0; i < problem.contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real limit = problem.contact.friction * normalImpulse[k];
        const Real slip = dot(problem.relativeVelocity(i), tangent);
        const Vec2 friction = std::clamp(-problem.point(i).tangentMass * slip, -limit, limit) * tangent;
        problem.apply(i, friction);
        impulses[k] += friction;
    }
    return impulses;
}

/// Work done on the relative motion: impulse times mean relative velocity, summed over the points (exact, as velocities
/// depend linearly on impulses). The bilinear form below it serves the blend.
Real workOf(const ImpactProblem& before, const Impulses& first, const Impulses& second) {
    ImpactProblem after = before;
    for (int i = 0; i < before.contact.count; ++i) { after.apply(i, second[static_cast<std::size_t>(i)]); }
    Real work = 0;
    for (int i = 0; i < before.contact.count; ++i) {
        const Vec2 mean = Real(0.5) * (before.relativeVelocity(i) + after.relativeVelocity(i));
        work += dot(first[static_cast<std::size_t>(i)], mean);
    }
    return work;
}

Impulses mix(const Impulses& plastic, const Impulses& full, Real share) {
    Impulses mixed{};
    for (std::size_t i = 0; i < 2; ++i) { mixed[i] = plastic[i] + share * (full[i] - plastic[i]); }
    return mixed;
}

/// The largest share of the full solution that makes no energy, by halving: work(share) is convex, not positive at 0 and
/// positive at 1, so there is one crossing. As many halvings as the significand has bits decide it.
Impulses withoutEnergyGain(const ImpactProblem& problem, const Impulses& full) {
    // Without friction a restitution of at most 1 cannot make energy; what shows here is rounding.
    if (problem.contact.friction <= 0 || workOf(problem, full, full) <= 0) { return full; }
    const Impulses plastic = impulsesFor(problem, {0, 0});
    Real low = 0;
    Real high = 1;
    for (int i = 0; i < std::numeric_limits<Real>::digits; ++i) {
        const Real middle = Real(0.5) * (low + high);
        const Impulses mixed = mix(plastic, full, middle);
        (workOf(problem, mixed, mixed) <= 0 ? low : high) = middle;
    }
    return mix(plastic, full, low);
}

}  // namespace

bool resolveImpact(ContactConstraint& contact, const SolverBodies& bodies, const ImpactRule& rule) {
    ImpactProblem problem{contact,
                          bodies.states[contact.slotA],
                          bodies.states[contact.slotB],
                          bodies.inertias[contact.slotA],
                          bodies.inertias[contact.slotB]};
    Scalars restitution{};
    Scalars approach{};
    for (int i = 0; i < contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        approach[k] = -dot(problem.relativeVelocity(i), contact.normal);
        if (contact.points[k].normalMass <= 0 || approach[k] <= kRoundingRatio * problem.speedScale(i)) { continue; }
        const bool bounces = contact.restitution > 0 && approach[k] > rule.restitutionThreshold;
        const bool meets = rule.horizon <= 0 || currentSeparation(contact, contact.points[k], problem.a, problem.b) <=
                                                    approach[k] * rule.horizon;
        problem.active[k] = meets && (bounces || rule.resolvePlastic);
        restitution[k] = bounces ? contact.restitution : Real(0);
    }
    if (!problem.active[0] && !problem.active[1]) { return false; }

    const Impulses impulses = withoutEnergyGain(problem, impulsesFor(problem, restitution));
    bool applied = false;
    for (int i = 0; i < contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!problem.active[k]) { continue; }
        problem.apply(i, impulses[k]);
        const Real normalImpulse = dot(impulses[k], contact.normal);
        contact.points[k].totalNormalImpulse += normalImpulse;
        contact.points[k].bounceApproach = std::max(contact.points[k].bounceApproach, approach[k]);
        applied = applied || normalImpulse > 0;
    }
    storePair(bodies, contact.slotA, problem.a, contact.slotB, problem.b);
    return applied;
}

int resolveImpacts(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                   int maxRounds) {
    for (int round = 0; round < maxRounds; ++round) {
        bool applied = false;
        for (ContactConstraint* contact : contacts) { applied = resolveImpact(*contact, bodies, rule) || applied; }
        if (!applied) { return round; }
    }
    return maxRounds;
}

}  // namespace swept::inline SWEPT_PRECISION
