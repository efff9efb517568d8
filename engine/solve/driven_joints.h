#pragma once

#include <array>

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Joints that calls moved: another length, other limits, another target. What they do for some steps is work, as that
/// of a winch: the energy guard (energy_guard.h) took the swing from whatever hung on a rope that was reeled in.

/// What a call moves.
struct DrivenMove {
    Real farthest = 0;  ///< how far what it holds its bodies to has moved, metres; nothing is noted of what did not
    std::array<Real, 2> way{};  ///< as in `DrivenJoint`; 0 of what came or went
    Real lever = 1;             ///< metres by unit of that
};

void noteDriven(WorldState& world, JointId joint, const DrivenMove& move);
/// As far as a call moved what the spring of a joint pulls to, metres. It is kept apart from the moves of its limits:
/// no spring goes on at a pace, and the order of the calls does not matter.
void noteSpringDriven(WorldState& world, JointId joint, Real farthest);
/// One of its bodies was put elsewhere. What has no gap as the next step begins was no move of the joint, as where all
/// of a group is put elsewhere, body by body.
void notePut(WorldState& world, JointId joint);
/// Before a step: targets, and limits that move steadily, set out for where they were set to, and get there at its end.
void beginDriven(WorldState& world, double dt);
/// After a step: targets are there, and what is as good as closed is driven no longer.
void endDriven(WorldState& world);
/// Null unless calls moved the joint of late.
const DrivenJoint* drivenOf(const WorldState& world, const Joint& joint);
/// How fast a joint draws, and does work in this step, as that of a winch, m/s; 0: it does none.
Real woundSpeed(const DrivenJoint& driven);
/// Tells the accounts of the islands of a solve.
void markDrivenAccounts(WorldState& world, const TiedGroup& group);

}  // namespace swept::inline SWEPT_PRECISION
