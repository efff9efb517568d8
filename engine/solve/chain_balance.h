#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Small gains add up. Where several rigid joints hold one body, iteration may leave a shaking that each step makes a
/// little faster, by less than what any one step is allowed (energy_gain.h). So of a chain whose account is known
/// (`JointChain::lends`: nothing but joints, gravity, forces and damping has a part in its motion) what solves gained
/// is added up, and what they took pays for it. What is beyond the allowance of one step the chain pays, and as much
/// again: of what is left alone nothing grows, but nothing would end, either.

struct SolvedPart {
    bool isFirst = true;  ///< of the step
    double parts = 1;     ///< of that length, in a step
};

/// What damping took of the motion of chains in the solve that was booked, and of those that nothing holds how they
/// went as a whole: into `SolveDesk::chainSums`, by place in the list of chains; of an island that advances by itself
/// there is one. @pre `JointChain::lends` and `isDamped`
void addUpChains(WorldState& world, const TiedGroup& group, Real time);

/// Books what a chain gained in that solve, and what it owes for it. Seen from its centre of mass if nothing holds it,
/// so that neither fall nor flight hides anything. @pre `addUpChains`, if the chain is damped or nothing holds it
void noteBalance(JointChain& chain, const ChainSums* sums, EnergyAccount& account, const SolvedPart& part);

}  // namespace swept::inline SWEPT_PRECISION
