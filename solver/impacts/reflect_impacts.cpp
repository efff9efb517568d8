#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "impact.h"
#include "impact_problem.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Told from the velocities alone, for the many that do not: whether a point approaches as fast as the rule asks.
bool mayApproach(const ContactConstraint& contact, const SolverBodies& bodies, const ImpactRule& rule) {
    const BodyState& a = bodies.states[contact.slotA];
    const BodyState& b = bodies.states[contact.slotB];
    const Real least = rule.resolvePlastic ? Real(0) : rule.restitutionThreshold;
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
        const ContactConstraintPoint& point = contact.points[k];
        const Vec2 velocity = velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA);
        if (-dot(velocity, contact.normal) > least) { return true; }
    }
    return false;
}

bool isMarked(const ImpactScratch& scratch, BodySlot slot, std::uint32_t sinceRound) {
    return scratch.seen[slot] >= sinceRound;
}

/// Marks the bodies of a contact that approaches. @return whether one of them had been marked in this round
bool markBodies(const ContactConstraint& contact, const SolverBodies& bodies, ImpactScratch& scratch) {
    bool shared = false;
    for (const BodySlot slot : {contact.slotA, contact.slotB}) {
        if (!isMovable(bodies.inertias[slot])) { continue; }
        shared = shared || scratch.seen[slot] == scratch.round;
        scratch.seen[slot] = scratch.round;
    }
    return shared;
}

/// Begins a call: nothing is marked.
void beginRounds(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, ImpactScratch& scratch) {
    scratch.visits = 0;
    scratch.round = 0;
    scratch.seen.assign(bodies.states.size(), 0);
    scratch.slots.clear();
    for (const ContactConstraint* contact : contacts) { scratch.slots.push_back({contact->slotA, contact->slotB}); }
}

/// Lists what approaches now: in the first round of a call among all contacts, later among those of bodies that the
/// round before may have moved; the others have not begun to. @return whether two of them share a body that can be
/// moved, and none differs in restitution (what is too slow to bounce has none)
bool listApproaching(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                     ImpactScratch& scratch) {
    scratch.approaching.clear();
    scratch.speeds.clear();
    scratch.scales.clear();
    const std::uint32_t before = scratch.round++;
    bool shared = false;
    bool alike = true;
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        const auto [slotA, slotB] = scratch.slots[i];
        if (before > 0 && !isMarked(scratch, slotA, before) && !isMarked(scratch, slotB, before)) { continue; }
        ++scratch.visits;
        ContactConstraint* const contact = contacts[i];
        if (!mayApproach(*contact, bodies, rule)) { continue; }
        const Approach approach = approachOf(problemOf(*contact, bodies), rule);
        if (!approach.any()) { continue; }
        const Real restitution = std::max(approach.restitution[0], approach.restitution[1]);
        alike = alike && (scratch.approaching.empty() || scratch.restitution == restitution);
        scratch.restitution = restitution;
        scratch.approaching.push_back(contact);
        scratch.speeds.push_back(
            {approach.active[0] ? approach.speed[0] : Real(0), approach.active[1] ? approach.speed[1] : Real(0)});
        scratch.scales.push_back(approach.scale);
        shared = markBodies(*contact, bodies, scratch) || shared;
    }
    return shared && alike;
}

/// How much work a call may be.
struct ImpactBudget {
    /// Sweeps of the projection: each takes an impact one contact further, and the soft tail does not matter, since the
    /// energy is made right at the end.
    std::size_t sweeps;
    /// Where thousands press against each other, rounds and sweeps would take seconds and still not be done. So the
    /// contacts that a call visits, in all rounds and sweeps together, are counted: so many are free …
    std::size_t always;
    /// … and beyond that there are so many for each contact. What still approaches then is plastic, the solver's.
    std::size_t perContact;
};
/// Up to 8 contacts do as they like, from 8192 on there are 2 visits for each of them.
constexpr ImpactBudget kFineBudget{.sweeps = 64, .always = 16384, .perContact = 2};
/// Profile `fast`: a pile of 1500 that is stirred took twelve times as long for its blows as for all else (`swept bench
/// world`, spinner).
constexpr ImpactBudget kCoarseBudget{.sweeps = 8, .always = 1024, .perContact = 2};
/// Fewer sweeps than this are no projection.
constexpr std::size_t kFewestSweeps = 2;
/// After each so many sweeps it is asked whether they come to an end …
constexpr std::size_t kSweepsToTell = 8;
/// … of which each takes away at least this part of a change, even in a wedge of one degree.
constexpr Real kSameChange = Real(1023) / Real(1024);
/// A round of plastic impacts that leaves this part of the approach of the one before will be followed by more of them.
constexpr Real kSameApproach = Real(63) / Real(64);

/// The bodies of a contact where they are: a sweep reads and writes their velocities, and leaves the rest of their
/// states.
struct BodyPair {
    BodyState& a;
    BodyState& b;
    BlowPair blow;

    Vec2 relativeVelocity(const ContactConstraintPoint& point) const {
        return velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA);
    }
    void apply(std::size_t point, Vec2 impulse) const { blow.apply(static_cast<int>(point), impulse, a, b); }
    Real normalMass(std::size_t point) const { return blow.normalMass(static_cast<int>(point)); }
    Real tangentMass(std::size_t point) const { return blow.tangentMass(static_cast<int>(point)); }
};

BodyPair pairOf(const ContactConstraint& contact, const SolverBodies& bodies) {
    return {bodies.states[contact.slotA], bodies.states[contact.slotB], blowPairOf(contact, bodies)};
}

/// One Gauss–Seidel sweep of the projection. @return the largest change of a normal velocity, relative to the speeds
/// that it is made of: those of the bodies, for a slow approach of what is fast is no better known. (Relative to the
/// approach itself it was rounding that most sweeps went on for: 54 of 64, now 9, in the mean of `spinner`.)
Real projectOnce(const SolverBodies& bodies, ImpactScratch& scratch) {
    Real largest = 0;
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        const ContactConstraint& contact = *scratch.approaching[c];
        const BodyPair pair = pairOf(contact, bodies);
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
            const ContactConstraintPoint& point = contact.points[k];
            const Real before = scratch.speeds[c][k];
            if (!(before > 0)) { continue; }
            const Real speed = -dot(pair.relativeVelocity(point), contact.normal);
            Real& impulse = scratch.impulses[c][k];
            const Real mass = pair.normalMass(k);
            const Real total = std::max(impulse + mass * speed, Real(0));
            if (total == impulse) { continue; }
            pair.apply(k, (total - impulse) * contact.normal);
            largest = std::max(largest, std::fabs(total - impulse) / (mass * scratch.scales[c][k]));
            impulse = total;
        }
    }
    return largest;
}

/// Factor on the impulses of the projection that makes them a reflection: work done is (1 − e²) of what a plastic
/// impact takes, as if the projection had converged. (Impulses λ, speeds before −v: work of s·λ is s·v·λ + s²·q/2, q =
/// λ·(change of v).)
Real reflectionFactor(const SolverBodies& bodies, const ImpactScratch& scratch) {
    Real given = 0;
    Real change = 0;
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        const ContactConstraint& contact = *scratch.approaching[c];
        const BodyPair pair = pairOf(contact, bodies);
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
            const Real impulse = scratch.impulses[c][k];
            const Real speed = -dot(pair.relativeVelocity(contact.points[k]), contact.normal);
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
        const BodyPair pair = pairOf(contact, bodies);
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
            pair.apply(k, ((factor - 1) * scratch.impulses[c][k]) * contact.normal);
        }
    }
    for (std::size_t c = 0; c < scratch.approaching.size(); ++c) {
        ContactConstraint& contact = *scratch.approaching[c];
        const BodyPair pair = pairOf(contact, bodies);
        const Vec2 tangent = rightPerp(contact.normal);
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
            ContactConstraintPoint& point = contact.points[k];
            const Real impulse = factor * scratch.impulses[c][k];
            const Real limit = contact.friction * impulse;
            const Real slip = dot(pair.relativeVelocity(point), tangent) - contact.surfaceSpeed;
            pair.apply(k, std::clamp(-pair.tangentMass(k) * slip, -limit, limit) * tangent);
            point.totalNormalImpulse += impulse;
            point.bounceApproach = std::max(point.bounceApproach, scratch.speeds[c][k]);
        }
    }
}

/// Whether one body meets things that nothing moves, and no other body.
bool isOfOneBody(const SolverBodies& bodies, const ImpactScratch& scratch) {
    const ContactConstraint& first = *scratch.approaching.front();
    const BodySlot one = isMovable(bodies.inertias[first.slotA]) ? first.slotA : first.slotB;
    const auto& approaching = scratch.approaching;
    return std::all_of(approaching.begin(), approaching.end(), [&](const ContactConstraint* contact) {
        const bool isA = contact->slotA == one;
        const BodySlot other = isA ? contact->slotB : contact->slotA;
        return (isA || contact->slotB == one) && !isMovable(bodies.inertias[other]);
    });
}

Real fastestApproach(const ImpactScratch& scratch) {
    Real fastest = 0;
    for (const std::array<Real, 2>& speeds : scratch.speeds) { fastest = std::max({fastest, speeds[0], speeds[1]}); }
    return fastest;
}

/// @param mostSweeps, visitsLeft  of the call
/// @return whether it is of any use to go on: not where a body is squeezed by things that nothing moves (a press and
/// the floor). No speed keeps it out of both, so that sweeps would push it to and fro as hard for ever.
bool reflectTogether(const SolverBodies& bodies, ImpactScratch& scratch, std::size_t mostSweeps,
                     std::size_t visitsLeft) {
    const std::size_t size = scratch.approaching.size();
    scratch.impulses.assign(size, {});
    // A later round finds what this one stirred up: it gets its share.
    const std::size_t sweeps = std::clamp(visitsLeft / (2 * size), kFewestSweeps, mostSweeps);
    Real before = std::numeric_limits<Real>::infinity();
    bool isSqueezed = false;
    for (std::size_t sweep = 1; sweep <= sweeps && !isSqueezed; ++sweep) {
        scratch.visits += size;
        const Real change = projectOnce(bodies, scratch);
        if (change <= kRoundingRatio) { break; }
        if (sweep % kSweepsToTell != 0) { continue; }
        isSqueezed = change >= kSameChange * before && isOfOneBody(bodies, scratch);
        before = change;
    }
    finishReflection(bodies, isSqueezed ? Real(1) : reflectionFactor(bodies, scratch), scratch);
    return !isSqueezed;
}

}  // namespace

int reflectImpacts(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                   int maxRounds, ImpactScratch& scratch) {
    const ImpactBudget& budget = rule.isCoarse ? kCoarseBudget : kFineBudget;
    const std::size_t most = std::max(budget.always, budget.perContact * contacts.size());
    beginRounds(contacts, bodies, scratch);
    Real before = std::numeric_limits<Real>::infinity();
    for (int round = 0; round < maxRounds; ++round) {
        if (scratch.visits >= most) { return round; }
        if (listApproaching(contacts, bodies, rule, scratch)) {
            // Friction may hold a body where it cannot get out of the way: each round would do the same again.
            const Real approach = fastestApproach(scratch);
            const bool isHeld = !(scratch.restitution > 0) && approach >= kSameApproach * before;
            if (isHeld && isOfOneBody(bodies, scratch)) { return round; }
            before = approach;
            const std::size_t left = most - std::min(most, scratch.visits);
            if (!reflectTogether(bodies, scratch, budget.sweeps, left)) { return round + 1; }
            continue;
        }
        bool applied = false;
        for (ContactConstraint* contact : scratch.approaching) {
            applied = resolveImpact(*contact, bodies, rule) || applied;
        }
        if (!applied) { return round; }
    }
    return maxRounds;
}

}  // namespace swept::inline SWEPT_PRECISION
