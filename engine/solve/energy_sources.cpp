#include "energy_sources.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../containers/any_of.h"
#include "energy_gain.h"
#include "motor_work.h"
#include "spring_energy.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// How a body stood and moved before the solve, from what that did to it.
BodyMotion motionBefore(const WorldState& world, const SolveDesk& desk, std::uint32_t slot) {
    BodyMotion motion = world.motions[slot];
    if (world.solverSlots[slot] == kFixedSlot) { return motion; }
    const EnergyEntry& entry = desk.energyEntries[world.solverSlots[slot] - 1];
    motion.center -= toDouble(entry.moved);
    motion.angle -= static_cast<double>(entry.turned);
    motion.pose.rotation = rotationFromAngle(motion.angle);
    motion.velocity = entry.velocityBefore;
    motion.angularVelocity = entry.spinBefore;
    return motion;
}

/// Of what moves in a solve: its place there, once more while springs are asked.
void placeMovable(WorldState& world, const SolveDesk& desk, bool isAsked) {
    forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
        world.solverSlots[slot] = isAsked ? static_cast<BodySlot>(i + 1) : kFixedSlot;
    });
}

}  // namespace

void bookMotors(WorldState& world, const TiedGroup& group, double time) {
    const auto isAsked = [&](const JointTie& tie) {
        if (tie.isPassive) { return false; }
        const EnergyAccount& account = accountOf(world, tie);
        return account.solve == group.desk.energySolve && !account.isFed && account.gained > account.work;
    };
    bool isPlaced = false;
    for (const std::uint32_t i : group.joints) {
        const JointTie& tie = world.jointTies[i];
        if (!isAsked(tie)) { continue; }
        EnergyAccount& account = accountOf(world, tie);
        const Joint& joint = world.joints[i];
        const double most = mostWorkOf(joint, time);
        if (!std::isinf(most)) {
            account.motors += most;
            continue;
        }
        if (!std::exchange(isPlaced, true)) { placeMovable(world, group.desk, true); }
        const JointMoves moves{.beforeA = motionBefore(world, group.desk, tie.bodyA),
                               .beforeB = motionBefore(world, group.desk, tie.bodyB),
                               .afterA = world.motions[tie.bodyA],
                               .afterB = world.motions[tie.bodyB]};
        account.motors += workDoneBy(world, joint, moves);
        account.isSprung = true;
    }
    if (isPlaced) { placeMovable(world, group.desk, false); }
}

namespace {

/// Springs give no more than they held. What they hold after a solve, as sub-steps keep it, may be less than nothing,
/// by a small part of the kinetic energy: where that has burst, by more than there was. (Three boxes on four welds, one
/// of a hundredth of the mass, kept 2·10¹⁰ J of 6·10¹⁴ in a step that began with 2.)
void boundSprings(EnergyAccount& account) {
    const double before = account.springs + account.stored;
    const double kinetic = std::max(account.kinetic - account.gained, 0.0);
    const double most = std::max(before, 0.0) + kSprungGain * kinetic;
    if (!(account.springs > most)) { return; }
    account.springs = most;
    account.stored = before - most;
}

}  // namespace

void bookSprings(WorldState& world, const TiedGroup& group, Real h) {
    const auto isAsked = [&](std::uint32_t joint) {
        const JointTie& tie = world.jointTies[joint];
        if (!tie.isSprung) { return false; }
        const EnergyAccount& account = accountOf(world, tie);
        return account.solve == group.desk.energySolve && account.gained > account.work;
    };
    if (noneOf(group.joints, isAsked)) { return; }
    placeMovable(world, group.desk, true);
    for (const std::uint32_t i : group.joints) {
        if (!isAsked(i)) { continue; }
        const JointTie& tie = world.jointTies[i];
        const Joint& joint = world.joints[i];
        const double before = springEnergyOf(world, joint, h, motionBefore(world, group.desk, tie.bodyA),
                                             motionBefore(world, group.desk, tie.bodyB));
        const double after = springEnergyOf(world, joint, h, world.motions[tie.bodyA], world.motions[tie.bodyB]);
        EnergyAccount& account = accountOf(world, tie);
        account.springs += before - after;
        account.stored += after;
        account.isSprung = true;
    }
    placeMovable(world, group.desk, false);
    for (const std::uint32_t root : group.desk.energyRoots) { boundSprings(world.energyAccounts[root]); }
}

}  // namespace swept::inline SWEPT_PRECISION
