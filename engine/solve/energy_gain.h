#pragma once

#include <algorithm>
#include <cmath>

#include "../bodies/body_joints.h"
#include "tied_group.h"

/// What counts as a gain of energy (energy_guard.h).

namespace swept::inline SWEPT_PRECISION {

/// Rounding of velocities, as a part of the kinetic energy.
inline constexpr double kGainRounding = 8 * static_cast<double>(kEpsilon);
/// What rests trembles by its contacts' give: this part of the energy that it would gain in free fall is no gain.
inline constexpr double kGainTremble = 1.0 / 1024;

/// Of this part of its energy islands with joints may gain anything. And nets give way: one that sags swings back with
/// what its gaps held, by four times as much in a step as it would gain in free fall. What takes turns with contacts is
/// held closer: it bursts with up to hundreds of times that. What nothing holds falls as a whole, and sags nowhere.
inline constexpr double kJointedGain = 1.0 / 64;
inline constexpr double kMostFalls = 16;
/// Where springs take part, of what moves and what they hold: while rigid joints are solved at once, what turns on
/// springs is up to a tenth off within a step, now more, now less, and would lose by it.
inline constexpr double kSprungGain = 1.0 / 8;
inline constexpr double kMostFallsInTouch = 1.0 / 4;

/// Overlaps are pushed out without speed, which lifts at no cost. Joints that touch nothing pay for that: what hung on
/// limits rose step by step, and was given what it fell again (five boxes by 11 m in 15 s, once the first one had a
/// thousandth of its inertia).
inline double excessOf(const EnergyAccount& account) {
    const bool pays = account.isJointed && !account.isTouching && !account.isYanked;
    const double work = pays ? account.work : std::max(account.work, 0.0);
    return account.gained - account.springs - account.motors - account.returned - work;
}

/// Of what nothing outside holds or touches, as seen from its centre of mass: how fast it goes as a whole does not
/// matter.
inline double ownKinetic(const EnergyAccount& account) {
    return account.meetsGround ? account.kinetic : account.kinetic - account.drift;
}

/// @param falls  that joints may give back
inline bool hasGained(const EnergyAccount& account, double falls) {
    if (account.isJointed) {
        return excessOf(account) >
               (account.isSprung ? kSprungGain : kJointedGain) * (ownKinetic(account) + account.stored) +
                   falls * account.fall;
    }
    return excessOf(account) > kGainRounding * account.kinetic + kGainTremble * account.fall;
}
inline bool hasGainedAtOnce(const EnergyAccount& account) {
    const double held = account.isTouching ? kMostFallsInTouch : kMostFalls;
    return hasGained(account, account.isAnchored || account.meetsGround ? held : 0);
}
inline bool hasGained(const EnergyAccount& account) { return account.owed > 0 || hasGainedAtOnce(account); }

/// What an island that gained pays.
inline double dueOf(const EnergyAccount& account) {
    const double excess = account.owed > 0 && !hasGainedAtOnce(account) ? 0 : excessOf(account);
    return std::max(excess, account.owed);
}

/// Of a speed, where `taken` of its `energy` is taken. What is left of far more is rounding: an island that burst with
/// 10⁴² J where it had 27 would go on with 10²⁶.
/// @param all  energy of which both are parts
inline double speedLeft(double energy, double taken, double all) {
    constexpr double kRounding = 0x1p-40;
    return energy - taken > kRounding * all ? std::sqrt(1 - taken / energy) : 0;
}

/// kg·m²; 0 of what does not turn.
inline double inertiaOf(const Body& body) { return body.inverseInertia > 0 ? body.inertia : 0; }

inline double squared(double x) { return x * x; }
inline double squared(DVec2 v) { return dot(v, v); }

inline EnergyAccount& accountOf(WorldState& world, std::uint32_t slot) {
    return world.energyAccounts[world.islands.find(slot)];
}

inline EnergyAccount& accountOf(WorldState& world, const JointTie& tie) {
    return accountOf(world, dynamicBodyOf(world, tie));
}

/// Of what is solved, all that can be moved. @param visit  gets the place among `SolveDesk::bodies`, and the slot
template <class Visit>
void forEachMoved(const SolveDesk& desk, const Visit& visit) {
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        if (isMovable(desk.batch.inertias[i + 1])) { visit(i, desk.bodies[i]); }
    }
}

/// Of the members of the group, those whose island gained.
template <class Visit>
void forEachGainer(WorldState& world, const TiedGroup& group, const Visit& visit) {
    for (const std::uint32_t slot : group.bodies) {
        const Body& body = world.bodies[slot];
        if (!body.isDynamic() || !isMember(body, group)) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        if (account.solve == group.desk.energySolve && !account.isFed && hasGained(account)) { visit(slot, account); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
