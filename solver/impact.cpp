#include "impact.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Below this ratio of the determinant to the product of its diagonal, a response is singular as far as rounding can tell:
/// two points act as one (same place, or no rotation).
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

/// Smallest non-negative impulses that change both normal velocities by `change` (both points approach).
Scalars solveBlock(const ImpactProblem& problem, const Scalars& change) {
    const Real k00 = problem.response(0, 0);
    const Real k11 = problem.response(1, 1);
    const Real k01 = problem.response(0, 1);
    const Real determinant = k00 * k11 - k01 * k01;
    if (determinant <= kSingularRatio * k00 * k11) {
        // Any split moves the bodies alike. Where the points approach at different speeds (a kinematic partner turns), only
        // the faster one may carry the impact: at the slower one the same impulse would do less work going in than out.
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

/// One point, normal and friction together: the normal velocity changes by exactly `change`, and friction opposes the slip
/// that remains. Along the impulses with that normal change (normal = (change − coupling·friction)/kNormal), slip grows
/// with friction, and the cone is an interval around 0: so the friction that would stop the slip, clamped to it, is the
/// only solution. With restitution 0 it never makes energy (Moreau's argument: no work at the normal end velocity 0, and
/// friction against the slip at the end).
Vec2 solvePoint(const ImpactProblem& problem, int i, Real change) {
    const Vec2 normal = problem.contact.normal;
    const Vec2 tangent = rightPerp(normal);
    const Real friction = problem.contact.friction;
    const Real normalMass = problem.point(i).normalMass;
    const Real kNormal = 1 / normalMass;
    const Real kTangent = 1 / problem.point(i).tangentMass;
    const Real coupling = problem.coupling(i, tangent);
    const Real kSlip = std::max(kTangent - coupling * coupling * normalMass, kSingularRatio * kTangent);
    const Real slip = dot(problem.relativeVelocity(i), tangent) + coupling * change * normalMass;
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
    const Vec2 normal = problem.contact.normal;
    const Vec2 tangent = rightPerp(normal);
    const Scalars normalImpulse = solveBlock(problem, change);
    Impulses impulses{normalImpulse[0] * normal, normalImpulse[1] * normal};
    for (int i = 0; i < 2; ++i) { problem.apply(i, impulses[static_cast<std::size_t>(i)]); }
    for (int i = 0; i < 2; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real limit = problem.contact.friction * normalImpulse[k];
        const Real slip = dot(problem.relativeVelocity(i), tangent);
        const Vec2 friction = std::clamp(-problem.point(i).tangentMass * slip, -limit, limit) * tangent;
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
        const Real approach = -dot(problem.relativeVelocity(i), problem.contact.normal);
        if (problem.active[k]) { change[k] = (1 + restitution[k]) * approach; }
    }
    if (problem.active[0] && problem.active[1]) { return solveTwoPoints(problem, change); }
    if (problem.active[0]) { return {solvePoint(problem, 0, change[0]), Vec2{}}; }
    return {Vec2{}, solvePoint(problem, 1, change[1])};
}

/// Work done on the relative motion: impulse times mean relative velocity, summed over the points (exact, as velocities
/// depend linearly on impulses).
Real workOf(const ImpactProblem& before, const Impulses& impulses) {
    ImpactProblem after = before;
    for (int i = 0; i < before.contact.count; ++i) { after.apply(i, impulses[static_cast<std::size_t>(i)]); }
    Real work = 0;
    for (int i = 0; i < before.contact.count; ++i) {
        const Vec2 mean = Real(0.5) * (before.relativeVelocity(i) + after.relativeVelocity(i));
        work += dot(impulses[static_cast<std::size_t>(i)], mean);
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
    if (problem.contact.friction <= 0 || workOf(problem, full) <= 0) { return full; }
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

/// Which points take part in an impact, and how.
struct Approach {
    Scalars speed{};        ///< m/s; of points that take no part, too
    Scalars restitution{};
    std::array<bool, 2> active{};

    bool any() const { return active[0] || active[1]; }
};

Approach approachOf(const ImpactProblem& problem, const ImpactRule& rule) {
    const ContactConstraint& contact = problem.contact;
    Approach approach;
    for (int i = 0; i < contact.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const Real speed = -dot(problem.relativeVelocity(i), contact.normal);
        approach.speed[k] = speed;
        if (contact.points[k].normalMass <= 0 || speed <= kRoundingRatio * problem.speedScale(i)) { continue; }
        const bool bounces = contact.restitution > 0 && speed > rule.restitutionThreshold;
        const bool meets = rule.horizon <= 0 || currentSeparation(contact, contact.points[k], problem.a, problem.b) <=
                                                    speed * rule.horizon;
        approach.active[k] = meets && (bounces || rule.resolvePlastic);
        approach.restitution[k] = bounces ? contact.restitution : Real(0);
    }
    return approach;
}

ImpactProblem problemOf(const ContactConstraint& contact, const SolverBodies& bodies) {
    return {contact, bodies.states[contact.slotA], bodies.states[contact.slotB], bodies.inertias[contact.slotA],
            bodies.inertias[contact.slotB]};
}

/// Lists what approaches now. @return whether two of them share a body that can be moved, and none differs in restitution
/// (what is too slow to bounce has none)
bool listApproaching(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                     ImpactScratch& scratch) {
    scratch.approaching.clear();
    scratch.speeds.clear();
    scratch.seen.resize(std::max(scratch.seen.size(), bodies.states.size()), 0);
    ++scratch.round;
    bool shared = false;
    bool alike = true;
    for (ContactConstraint* contact : contacts) {
        const Approach approach = approachOf(problemOf(*contact, bodies), rule);
        if (!approach.any()) { continue; }
        const Real restitution = std::max(approach.restitution[0], approach.restitution[1]);
        alike = alike && (scratch.approaching.empty() || scratch.restitution == restitution);
        scratch.restitution = restitution;
        scratch.approaching.push_back(contact);
        scratch.speeds.push_back(
            {approach.active[0] ? approach.speed[0] : Real(0), approach.active[1] ? approach.speed[1] : Real(0)});
        for (const BodySlot slot : {contact->slotA, contact->slotB}) {
            const BodyInertia& inertia = bodies.inertias[slot];
            if (!(inertia.inverseMass > 0) && !(inertia.inverseInertia > 0)) { continue; }
            shared = shared || scratch.seen[slot] == scratch.round;
            scratch.seen[slot] = scratch.round;
        }
    }
    return shared && alike;
}

/// Sweeps of the projection: each takes an impact one contact further, and the soft tail does not matter, since the energy is
/// made right at the end.
constexpr std::size_t kProjectionSweeps = 64;
/// Where thousands press against each other, rounds and sweeps would take seconds and still not be done. So the contacts that a
/// call visits, in all rounds and sweeps together, are counted: up to 8 contacts do as they like, from 8192 on there are 2
/// visits for each of them. What still approaches then is plastic, the solver's.
constexpr std::size_t kAlwaysVisits = 16384;
constexpr std::size_t kVisitsOfContact = 2;
/// Fewer sweeps than this are no projection.
constexpr std::size_t kFewestSweeps = 2;

/// One Gauss–Seidel sweep of the projection. @return the largest change of a normal velocity, relative to that before
Real projectOnce(const SolverBodies& bodies, ImpactScratch& scratch) {
    Real largest = 0;
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        const ContactConstraint& contact = *scratch.approaching[c];
        ImpactProblem problem = problemOf(contact, bodies);
        for (int i = 0; i < contact.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const Real before = scratch.speeds[c][k];
            if (!(before > 0)) { continue; }
            const Real speed = -dot(problem.relativeVelocity(i), contact.normal);
            Real& impulse = scratch.impulses[c][k];
            const Real total = std::max(impulse + contact.points[k].normalMass * speed, Real(0));
            problem.apply(i, (total - impulse) * contact.normal);
            largest = std::max(largest, std::fabs(total - impulse) / (contact.points[k].normalMass * before));
            impulse = total;
        }
        storePair(bodies, contact.slotA, problem.a, contact.slotB, problem.b);
    }
    return largest;
}

/// Factor on the impulses of the projection that makes them a reflection: work done is (1 − e²) of what a plastic impact takes,
/// as if the projection had converged. (Impulses λ, speeds before −v: work of s·λ is s·v·λ + s²·q/2, q = λ·(change of v).)
Real reflectionFactor(const SolverBodies& bodies, const ImpactScratch& scratch) {
    Real given = 0;
    Real change = 0;
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        const ContactConstraint& contact = *scratch.approaching[c];
        const ImpactProblem problem = problemOf(contact, bodies);
        for (int i = 0; i < contact.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const Real impulse = scratch.impulses[c][k];
            const Real speed = -dot(problem.relativeVelocity(i), contact.normal);
            given += impulse * scratch.speeds[c][k];
            change += impulse * (scratch.speeds[c][k] - speed);
        }
    }
    return change > 0 ? (1 + scratch.restitution) * (given / change) : Real(1);
}

/// The rest of the reflection, and friction within its cone against the slip that remains.
void finishReflection(const SolverBodies& bodies, Real factor, const ImpactScratch& scratch) {
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        const ContactConstraint& contact = *scratch.approaching[c];
        ImpactProblem problem = problemOf(contact, bodies);
        for (int i = 0; i < contact.count; ++i) {
            problem.apply(i, ((factor - 1) * scratch.impulses[c][static_cast<std::size_t>(i)]) * contact.normal);
        }
        storePair(bodies, contact.slotA, problem.a, contact.slotB, problem.b);
    }
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        ContactConstraint& contact = *scratch.approaching[c];
        ImpactProblem problem = problemOf(contact, bodies);
        const Vec2 tangent = rightPerp(contact.normal);
        for (int i = 0; i < contact.count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const Real impulse = factor * scratch.impulses[c][k];
            const Real limit = contact.friction * impulse;
            const Real slip = dot(problem.relativeVelocity(i), tangent);
            problem.apply(i, std::clamp(-contact.points[k].tangentMass * slip, -limit, limit) * tangent);
            contact.points[k].totalNormalImpulse += impulse;
            contact.points[k].bounceApproach = std::max(contact.points[k].bounceApproach, scratch.speeds[c][k]);
        }
        storePair(bodies, contact.slotA, problem.a, contact.slotB, problem.b);
    }
}

/// @param visitsLeft  of the call
void reflectTogether(const SolverBodies& bodies, ImpactScratch& scratch, std::size_t visitsLeft) {
    const std::size_t size = scratch.approaching.size();
    scratch.impulses.assign(size, {});
    // A later round finds what this one stirred up: it gets its share.
    const std::size_t sweeps = std::clamp(visitsLeft / (2 * size), kFewestSweeps, kProjectionSweeps);
    for (std::size_t sweep = 0; sweep < sweeps; ++sweep) {
        scratch.visits += size;
        if (projectOnce(bodies, scratch) <= kRoundingRatio) { break; }
    }
    finishReflection(bodies, reflectionFactor(bodies, scratch), scratch);
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

int reflectImpacts(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                   int maxRounds, ImpactScratch& scratch) {
    const std::size_t most = std::max(kAlwaysVisits, kVisitsOfContact * contacts.size());
    scratch.visits = 0;
    for (int round = 0; round < maxRounds; ++round) {
        if (scratch.visits >= most) { return round; }
        scratch.visits += contacts.size();
        if (listApproaching(contacts, bodies, rule, scratch)) {
            reflectTogether(bodies, scratch, most - std::min(most, scratch.visits));
            continue;
        }
        bool applied = false;
        for (ContactConstraint* contact : scratch.approaching) { applied = resolveImpact(*contact, bodies, rule) || applied; }
        if (!applied) { return round; }
    }
    return maxRounds;
}

}  // namespace swept::inline SWEPT_PRECISION
