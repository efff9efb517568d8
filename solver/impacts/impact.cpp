#include "impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "impact_problem.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Below this ratio of the determinant to the product of its diagonal, a response is singular as far as rounding can
/// tell: two points act as one (same place, or no rotation).
constexpr Real kSingularRatio = 16 * kEpsilon;
/// Impulse vectors (world) at the points.
using Impulses = std::array<Vec2, 2>;

/// Smallest non-negative impulses that change both normal velocities by `change` (both points approach).
Scalars solveBlock(const ImpactProblem& problem, const Scalars& change) {
    const Real k00 = problem.blow.response(0, 0);
    const Real k11 = problem.blow.response(1, 1);
    const Real k01 = problem.blow.response(0, 1);
    const Real determinant = k00 * k11 - k01 * k01;
    if (determinant <= kSingularRatio * k00 * k11) {
        // Any split moves the bodies alike. Where the points approach at different speeds (a kinematic partner turns),
        // only the faster one may carry the impact: at the slower one the same impulse would do less work going in than
        // out.
        if (change[0] == change[1]) { return {change[0] / (k00 + k11), change[1] / (k00 + k11)}; }
        return change[0] > change[1] ? Scalars{change[0] / k00, 0} : Scalars{0, change[1] / k11};
    }
    // Elimination instead of Cramer's rule: near a singular matrix its impulses still make the velocities asked for.
    const Real ratio = k01 / k00;
    const Real x1 = (change[1] - ratio * change[0]) / (k11 - ratio * k01);
    const Real x0 = (change[0] - k01 * x1) / k00;
    if (x0 >= 0 && x1 >= 0) { return {x0, x1}; }
    // One point alone carries the impact and lifts the other at least as much as asked.
    return x0 < 0 ? Scalars{0, change[1] / k11} : Scalars{change[0] / k00, 0};
}

/// One point, normal and friction together: the normal velocity changes by exactly `change`, and friction opposes the
/// slip that remains. Along the impulses with that normal change (normal = (change − coupling·friction)/kNormal), slip
/// grows with friction, and the cone is an interval around 0: so the friction that would stop the slip, clamped to it,
/// is the only solution. With restitution 0 it never makes energy (Moreau's argument: no work at the normal end
/// velocity 0, and friction against the slip at the end).
Vec2 solvePoint(const ImpactProblem& problem, int i, Real change) {
    const Vec2 normal = problem.contact().normal;
    const Vec2 tangent = rightPerp(normal);
    const Real friction = problem.contact().friction;
    const Real normalMass = problem.blow.normalMass(i);
    const Real kNormal = 1 / normalMass;
    const Real kTangent = 1 / problem.blow.tangentMass(i);
    const Real coupling = problem.blow.coupling(i);
    const Real kSlip = std::max(kTangent - coupling * coupling * normalMass, kSingularRatio * kTangent);
    const Real slip = problem.slip(i) + coupling * change * normalMass;
    // A side of the cone that the line of impulses never meets does not limit friction.
    const Real above = kNormal + friction * coupling;
    const Real below = kNormal - friction * coupling;
    Real total = -slip / kSlip;
    if (above > 0) { total = std::min(total, friction * change / above); }
    if (below > 0) { total = std::max(total, -friction * change / below); }
    return (change - coupling * total) * normalMass * normal + total * tangent;
}

/// Two points: normals together, then friction point by point. Each part by itself makes no energy.
Impulses solveTwoPoints(ImpactProblem problem, const Scalars& change) {
    const Vec2 normal = problem.contact().normal;
    const Vec2 tangent = rightPerp(normal);
    const Scalars normalImpulse = solveBlock(problem, change);
    Impulses impulses{normalImpulse[0] * normal, normalImpulse[1] * normal};
    for (int i = 0; i < 2; ++i) { problem.apply(i, impulses[static_cast<std::size_t>(i)]); }
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real limit = problem.contact().friction * normalImpulse[k];
        const Vec2 friction = std::clamp(-problem.blow.tangentMass(i) * problem.slip(i), -limit, limit) * tangent;
        problem.apply(i, friction);
        impulses[k] += friction;
    }
    return impulses;
}

/// Impulses for given restitutions of the points.
Impulses impulsesFor(const ImpactProblem& problem, const Scalars& restitution) {
    Scalars change{};
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real approach = -dot(problem.relativeVelocity(i), problem.contact().normal);
        if (problem.active[k]) { change[k] = (1 + restitution[k]) * approach; }
    }
    if (problem.active[0] && problem.active[1]) { return solveTwoPoints(problem, change); }
    if (problem.active[0]) { return {solvePoint(problem, 0, change[0]), Vec2{}}; }
    return {Vec2{}, solvePoint(problem, 1, change[1])};
}

/// Work done on the relative motion of the surfaces: impulse times mean relative velocity, summed over the points
/// (exact, as velocities depend linearly on impulses).
Real workOf(const ImpactProblem& before, const Impulses& impulses) {
    ImpactProblem after = before;
    for (int i = 0; i < before.contact().count; ++i) { after.apply(i, impulses[static_cast<std::size_t>(i)]); }
    const Vec2 belt = before.contact().surfaceSpeed * rightPerp(before.contact().normal);
    Real work = 0;
    for (int i = 0; i < before.contact().count; ++i) {
        const Vec2 mean = Real(0.5) * (before.relativeVelocity(i) + after.relativeVelocity(i)) - belt;
        work += dot(impulses[static_cast<std::size_t>(i)], mean);
    }
    return work;
}

Impulses mix(const Impulses& plastic, const Impulses& full, Real share) {
    Impulses mixed{};
    for (std::size_t i = 0; i < 2; ++i) { mixed[i] = plastic[i] + share * (full[i] - plastic[i]); }
    return mixed;
}

/// The largest share of the full solution that makes no energy, by halving: work(share) is convex, not positive at 0
/// and positive at 1, so there is one crossing. As many halvings as the significand has bits decide it.
Impulses withoutEnergyGain(const ImpactProblem& problem, const Impulses& full) {
    // Without friction a restitution of at most 1 cannot make energy; what shows here is rounding.
    if (problem.contact().friction <= 0 || workOf(problem, full) <= 0) { return full; }
    const Impulses plastic = impulsesFor(problem, {0, 0});
    Real low = 0;
    Real high = 1;
    for (int i = 0; i < std::numeric_limits<Real>::digits; ++i) {
        const Real middle = Real(0.5) * (low + high);
        const Impulses mixed = mix(plastic, full, middle);
        (workOf(problem, mixed) <= 0 ? low : high) = middle;
    }
    return mix(plastic, full, low);
}

}  // namespace

bool resolveImpact(ContactConstraint& contact, const SolverBodies& bodies, const ImpactRule& rule) {
    ImpactProblem problem = problemOf(contact, bodies);
    const Approach approach = approachOf(problem, rule);
    if (!approach.any()) { return false; }
    problem.active = approach.active;

    const Impulses impulses = withoutEnergyGain(problem, impulsesFor(problem, approach.restitution));
    bool applied = false;
    for (int i = 0; i < contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (!problem.active[k]) { continue; }
        problem.apply(i, impulses[k]);
        const Real normalImpulse = dot(impulses[k], contact.normal);
        contact.points[k].totalNormalImpulse += normalImpulse;
        contact.points[k].bounceApproach = std::max(contact.points[k].bounceApproach, approach.speed[k]);
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
