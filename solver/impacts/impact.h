#pragma once

#include <array>
#include <vector>

#include "../contacts/contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// Which points of a contact take part in an impact.
struct ImpactRule {
    /// Slower approaches than this (m/s) are plastic: restitution 0.
    Real restitutionThreshold = 0;
    /// Points that meet within this time (s) at their present approach speed count as touching; 0: all points do.
    Real horizon = 0;
    /// Whether points below the threshold are resolved too, plastically, or left to the contact solver.
    bool resolvePlastic = false;
    /// Whether a large number of contacts is gone through a few times only (`reflectImpacts`): what then still
    /// approaches is the contact solver's. A handful of contacts is resolved all the same.
    bool isCoarse = false;
};

/// Newton's impact law with Coulomb friction for all approaching points of one contact at once. One point: it leaves
/// with restitution times its approach speed, friction included. Two points: their normal velocities are reflected
/// together (a 2×2 block), then friction acts within the cone of the normal impulses (and may leave one approaching:
/// the next round's). Where that would make kinetic energy (Newton's rule with friction can), the impulses are blended
/// towards those of restitution 0 until it does not: the pair's kinetic energy relative to each other never grows (of
/// belts: as seen from where their surfaces stand still).
/// Records impulse and approach speed in the points. @return whether anything was applied.
bool resolveImpact(ContactConstraint& contact, const SolverBodies& bodies, const ImpactRule& rule);

/// Repeats `resolveImpact` over all contacts in turn until none approaches, at most `maxRounds` times: an impact
/// travels through a row of touching bodies one contact at a time. @return the rounds used; `maxRounds` means that some
/// may still approach (the contact solver then treats them as plastic).
int resolveImpacts(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                   int maxRounds);

/// What `reflectImpacts` needs; kept for its capacity.
struct ImpactScratch {
    std::vector<ContactConstraint*> approaching;
    std::vector<std::array<Real, 2>> impulses;   ///< by approaching contact and point, N·s
    std::vector<std::array<Real, 2>> speeds;     ///< approach speeds before, m/s; 0: the point takes no part
    std::vector<std::array<Real, 2>> scales;     ///< of the speeds that these are the difference of, m/s
    Real restitution = 0;                        ///< of the contacts in this round, 0 where they are too slow to bounce
    std::vector<std::array<BodySlot, 2>> slots;  ///< by contact
    std::vector<std::uint32_t> seen;  ///< by slot: the last round in which a contact there approached, from 1 on
    std::uint32_t round = 0;          ///< of the call
    std::size_t visits = 0;           ///< contacts visited by the last call, in all its rounds and sweeps: its cost
};

/// Like `resolveImpacts`, but contacts that approach at the same time and share a body are reflected together, whatever
/// their order: the velocities are projected onto those at which none of them approaches, and then changed as much
/// again, times the restitution (generalised reflections: Smith, Kaufman, Vouga, Tamstorf, Grinspun, "Reflections on
/// Simultaneous Impact", 2012). Keeps symmetry, and energy for restitution 1. Contacts of different restitution are
/// taken in turn. Its cost is bounded by the number of contacts: a few visits each among thousands, more among few. Of
/// one body that is squeezed by what nothing moves it takes what a few sweeps find, and leaves the rest.
int reflectImpacts(std::span<ContactConstraint* const> contacts, const SolverBodies& bodies, const ImpactRule& rule,
                   int maxRounds, ImpactScratch& scratch);

/// Rounds inside a sub-step: a row of so many touching bodies passes an impact on at once; longer rows take more
/// sub-steps.
inline constexpr int kMaxBounceRounds = 32;

}  // namespace swept::inline SWEPT_PRECISION
