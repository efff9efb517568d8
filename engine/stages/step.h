#pragma once

#include "../state/world_state.h"

/// The stages of a step, in their order. Each is a file of its own. Those for which a scene may have nothing to do
/// (fast islands, sweeps, sensors, breaking joints, sleep) are called only when there is something.

namespace swept::inline SWEPT_PRECISION {

/// Modes `speedLimit` (mode_speed_limit.cpp) and `speculative` (mode_speculative.cpp), before anything looks at speeds:
/// the one slows what is too fast, the other has the boxes of its bodies span their whole motion.
void limitSpeeds(WorldState& world, double dt);
void reachAhead(WorldState& world);
/// Mode `speedLimit` again, after the solve: what other bodies pushed does not go farther than it may either.
void limitWays(WorldState& world, double dt);
/// The boxes of kinematic bodies span their coming step, whatever their velocity was when the last one ended.
void reachWithKinematicBodies(WorldState& world);
/// Pairs of boxes that began to overlap, and what each is by itself (stage_pairs.cpp).
void findPairs(WorldState& world);
/// These become contacts, or candidates for that, in their order; what two of them met where nothing moves is awake
/// after the second call. (Stage of contacts: beside the first one others may look at bodies.)
void addPairs(WorldState& world);
void releaseMet(WorldState& world);
/// @return false when the two may not touch, or have a contact already
bool addContact(WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB);
/// Manifolds of all contacts with something awake (stage_collide.cpp).
void collideContacts(WorldState& world);
/// Which of them have points, without ghosts (ghosts.h), as far as their probes tell (stage_notice.cpp).
void listTouching(WorldState& world);
/// What follows from them, in their order: begin and end of touching; wakes what is touched.
void noticeContacts(WorldState& world);
/// Of probes that were told to pass each other: their manifolds, with whatever points are within reach; and, of those
/// that hold all the same, that they are part of what touches.
void collideHemmed(WorldState& world, std::span<const std::uint32_t> probes);
void listHemmed(WorldState& world, std::span<const std::uint32_t> probes);
/// Of what a later stage woke: its contacts are listed, too.
void listUnparked(WorldState& world);
/// Of some awake bodies: what the last step left is forgotten, and how fast each may be in this one is known. While
/// contacts are noticed others may do that. @param awake  slots @pre `traits` were cleared for this step
void resetBodies(WorldState& world, std::span<const std::uint32_t> awake, Real dt);
/// Decides which part each awake body plays, and groups what is tied together (stage_roles.cpp, note_touching.cpp).
void assignRoles(WorldState& world, Real dt);
void findIslands(WorldState& world);
/// Of the bodies of `tied`, into `tiedRoots`. @return how many islands these are
std::uint64_t findRoots(WorldState& world);
void findFastIslands(WorldState& world);
/// How the solver treats each island: sub-steps, method (effort.cpp).
void assignEfforts(WorldState& world, double dt);
/// Free flight, and the sub-stepped solve of all that is tied together (stage_solve.cpp).
void moveFreeBodies(WorldState& world, double dt);
void solveTiedBodies(WorldState& world, double dt);
/// Islands with something fast (stage_islands.cpp): what bounces in flight, and what the coming solve is a first try
/// of; after that solve the others, from impact to impact.
void beginFastIslands(WorldState& world, double dt);
void advanceFastIslands(WorldState& world, double dt);
/// After the sweeps, which see kinematic bodies at the start of their step.
void moveKinematicBodies(WorldState& world, double dt);
/// Flyers, and fast bodies held at their impacts (stage_continuous.cpp).
void sweepFastBodies(WorldState& world, double dt);
/// Begin and end of what passed sensors within the step, at its time (mode_sensors.cpp).
void sweepSensors(WorldState& world, double dt);
/// A body whose state is no number any more, or one too large to compute with (`kLargestNumber`), stays where it was at
/// the start of the step, at rest, and is counted (stage_guard.cpp). Only inputs at the ends of what can be written do
/// that.
void putBackOverflown(WorldState& world);
/// Breaking joints, boxes, sleep (stage_finish.cpp).
void breakJoints(WorldState& world);
void moveProxiesAndSortEvents(WorldState& world);
void putToSleep(WorldState& world, double dt);
/// The order of the events is found, and which of them chains have as one shape (event_order.cpp): by one worker, which
/// runs no loops. Then they are put into it.
void sortEvents(WorldState& world);
void putEventsInOrder(WorldState& world);
/// Of each body, and who lost more than its budget.
void countLostTime(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
