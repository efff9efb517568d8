#include "lent_energy.h"

#include <algorithm>

#include "../bodies/body_joints.h"
#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of what was taken, after each step. Gaps that opened within ten steps take three to close; with half of it the last
/// of these gave nothing back.
constexpr double kLentKept = 7.0 / 8;
/// Of the kinetic energy that an island has after a solve, the most that closing joints may have given it.
constexpr double kMostReturned = 1.0 / 2;

/// Several threads may ask at the same time.
JointChain& chainOf(WorldState& world, std::uint32_t joint) {
    JointChains& chains = world.jointChains;
    return chains.list[chains.places[chains.finder.rootOf(movingBodyOf(world, joint))]];
}

/// What it loses nothing gives back: friction, blows, damping.
bool losesOtherwise(const WorldState& world, std::uint32_t slot) {
    if ((world.traits[slot] & kHasContact) != 0) { return true; }
    const BodyDef& def = world.bodies[slot].def;
    return def.linearDamping > 0 || def.angularDamping > 0;
}

bool isDriven(const WorldState& world, std::uint32_t joint) { return world.joints[joint].driven != kNotDriven; }

void note(const WorldState& world, JointChain& chain, EnergyAccount& account) {
    LentEnergy& lent = chain.lent;
    const bool isOfLastStep = lent.step + 1 == world.steps;
    if (lent.step != world.steps) { lent.energy = isOfLastStep ? kLentKept * lent.energy : 0; }
    account.returned = std::min(lent.energy, kMostReturned * account.kinetic);
    lent.energy = std::max(0.0, lent.energy + account.work - account.gained);
    lent.step = world.steps;
}

void forget(JointChain& chain) {
    chain.lends = false;
    chain.lent = {};
}

/// Of the group of all that is solved together.
void noteLentOfAll(WorldState& world, const SolveDesk& desk) {
    JointChains& chains = world.jointChains;
    for (JointChain& chain : chains.list) {
        chain.lends = chain.mayLend && accountOf(world, chain.lowest).solve == desk.energySolve;
    }
    for (const JointChains::Member& member : chains.members) {
        JointChain& chain = chains.list[chains.places[member.lowest]];
        if (chain.lends && losesOtherwise(world, member.body)) { forget(chain); }
    }
    for (const DrivenJoint& driven : world.drivenJoints) {
        if (world.joints.find(driven.joint) == nullptr || !world.jointTies[driven.joint.index].holds) { continue; }
        if (JointChain& chain = chainOf(world, driven.joint.index); chain.lends) { forget(chain); }
    }
    for (JointChain& chain : chains.list) {
        if (chain.lends) { note(world, chain, accountOf(world, chain.lowest)); }
    }
}

/// Of an island that advances by itself.
void noteLentOfOne(WorldState& world, const TiedGroup& group) {
    const auto touches = [](const Contact& contact) { return !contact.sensor && contact.manifold.count > 0; };
    const auto loses = [&world](std::uint32_t slot) {
        return isAwakeDynamic(world, slot) && losesOtherwise(world, slot);
    };
    const auto mayLend = [&world](std::uint32_t joint) {
        return chainOf(world, joint).mayLend && (world.drivenJoints.empty() || !isDriven(world, joint));
    };
    const bool lends = std::none_of(group.contacts.begin(), group.contacts.end(), touches) &&
                       std::none_of(group.bodies.begin(), group.bodies.end(), loses) &&
                       std::all_of(group.joints.begin(), group.joints.end(), mayLend);
    if (!lends) {
        for (const std::uint32_t joint : group.joints) { forget(chainOf(world, joint)); }
        return;
    }
    JointChain& chain = chainOf(world, group.joints.front());
    note(world, chain, accountOf(world, chain.lowest));
}

/// Scattered, so that sums of several ids tell them apart.
std::uint64_t mixed(JointId id) {
    constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15U;
    std::uint64_t key = (std::uint64_t{id.generation} << 32U | id.index) * kGolden;
    key ^= key >> 32U;
    key *= kGolden;
    return key ^ key >> 32U;
}

}  // namespace

void noteLent(WorldState& world, const TiedGroup& group) {
    if (group.desk.isExact) { return; }  // what is solved exactly opens no joints
    if (group.role == BodyRole::solved) {
        noteLentOfAll(world, group.desk);
    } else {
        noteLentOfOne(world, group);
    }
}

LentEnergy* lentOf(WorldState& world, std::span<const std::uint32_t> joints) {
    return joints.empty() ? nullptr : &chainOf(world, joints.front()).lent;
}

void keepLent(WorldState& world) {
    JointChains& chains = world.jointChains;
    for (const std::uint32_t joint : world.activeJoints) {
        JointChain& chain = chainOf(world, joint);
        if (chain.mayLend) { chain.identity += mixed(world.joints.idOf(joint)); }
    }
    auto before = chains.before.begin();
    for (JointChain& chain : chains.list) {
        while (before != chains.before.end() && before->lowest < chain.lowest) { ++before; }
        if (before == chains.before.end()) { return; }
        const bool isSame = before->lowest == chain.lowest && before->joints == chain.joints;
        if (isSame && chain.mayLend && before->identity == chain.identity) { chain.lent = before->lent; }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
