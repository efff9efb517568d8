#pragma once

#include "../state/world_state.h"

/// A step of a world, and its stages in their order. Each is a file of its own. What modes (modes.h), efforts
/// (effort.h) and joints that calls move (driven_joints.h) have to do in a step stands with them; step.cpp says when.

namespace swept::inline SWEPT_PRECISION {

/// All of it (step.cpp). @pre the lists of the last step are emptied, `WorldState::loops` is set
void runStages(WorldState& world, double dt);

/// The boxes of kinematic bodies span their coming step, whatever their velocity was when the last one ended
/// (stage_continuous.cpp).
void reachWithKinematicBodies(WorldState& world);
/// Pairs of boxes that began to overlap, and what each is by itself (stage_pairs.cpp).
void findPairs(WorldState& world);
/// Manifolds of all contacts with something awake (stage_collide.cpp).
void collideContacts(WorldState& world);
/// Which of them have points, without ghosts (ghosts.h), as far as their probes tell (stage_notice.cpp).
void listTouching(WorldState& world);
/// What follows from them, in their order: begin and end of touching; wakes what is touched.
void noticeContacts(WorldState& world);
/// Decides which part each awake body plays, and groups what is tied together (stage_roles.cpp, note_touching.cpp).
void assignRoles(WorldState& world, Real dt);
void findIslands(WorldState& world);
/// Islands with something fast (stage_islands.cpp).
void findFastIslands(WorldState& world);
/// Free flight (stage_solve.cpp).
void moveFreeBodies(WorldState& world, double dt);
/// What bounces in flight, and what the coming solve is a first try of (stage_islands.cpp).
void beginFastIslands(WorldState& world, double dt);
/// The sub-stepped solve of all that is tied together (stage_solve.cpp).
void solveTiedBodies(WorldState& world, double dt);
/// The other fast islands, from impact to impact (stage_islands.cpp).
void advanceFastIslands(WorldState& world, double dt);
/// A body whose state is no number any more, or one too large to compute with (`kLargestNumber`), stays where it was at
/// the start of the step, at rest, and is counted (stage_guard.cpp). Only inputs at the ends of what can be written do
/// that.
void putBackOverflown(WorldState& world);
/// Whether a motion is such as nobody puts back.
bool isSound(const BodyMotion& motion);
/// Flyers, and fast bodies held at their impacts (stage_continuous.cpp).
void sweepFastBodies(WorldState& world, double dt);
/// After the sweeps, which see kinematic bodies at the start of their step (stage_solve.cpp).
/// @return whether all of them are sound still
bool moveKinematicBodies(WorldState& world, double dt);
/// What ends the step (stage_finish.cpp): joints break, boxes move, what rests falls asleep.
void breakJoints(WorldState& world);
void moveProxiesAndSortEvents(WorldState& world);
void putToSleep(WorldState& world, double dt);
/// Of each body, and who lost more than its budget.
void countLostTime(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
