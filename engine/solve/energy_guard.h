#pragma once

#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// Contacts make no energy. A pass of the contact solver starts from impulses of the sub-step before, pushes out of
/// overlaps, and takes the speed of both out again, one contact after the other: in a pile that something just struck,
/// a little of it is left behind. So what the kinetic energy of an island of contacts gained in a solve is held against
/// the work that gravity and forces did, and what is beyond that is taken from the motion of its members relative to
/// each other, or to the ground that they press on, along which they slide on as they did. So it is with joints, beyond
/// what their springs held, what their motors and targets gave (motor_work.h), and what their gaps may give back. What
/// touches kinematic bodies or belts is left alone: those may do work.

/// Begins a solve. @return whether it is watched at all: what is settled is not
bool openAccounts(WorldState& world, const TiedGroup& group);
/// Of a member of the group, before its motion is overwritten with what the solver made of it.
/// @param time  that was solved for, s
void noteEnergy(EnergyEntry& entry, const WorldState& world, std::uint32_t slot, const BodyState& state, Real time);
/// Books the entries of all members (`SolveDesk::energyEntries`). Sums depend on their order: one after the other.
void book(WorldState& world, SolveDesk& desk);
/// Takes back what islands gained. @pre all members were booked, and have their new motions
/// @param time  that was solved for, s
/// @param h     length of its sub-steps, s
/// @param dt    of the step that it is part of, s
void settleAccounts(WorldState& world, const TiedGroup& group, Real time, Real h, double dt);

}  // namespace swept::inline SWEPT_PRECISION
