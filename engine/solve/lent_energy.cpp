#include "lent_energy.h"

#include <algorithm>

#include "../bodies/body_joints.h"
#include "../containers/any_of.h"
#include "chain_balance.h"
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

bool touches(const WorldState& world, std::uint32_t slot) { return (world.traits[slot] & kHasContact) != 0; }

bool isDamped(const WorldState& world, std::uint32_t slot) {
    const BodyDef& def = world.bodies[slot].def;
    return def.linearDamping > 0 || def.angularDamping > 0;
}

bool isDriven(const WorldState& world, std::uint32_t joint) { return world.joints[joint].driven != kNotDriven; }

bool isSummedUp(const JointChain& chain) { return chain.lends && (chain.isDamped || chain.anchors == 0); }

/// @pre `addUpChains`, if it is summed up
void note(const WorldState& world, JointChain& chain, const ChainSums* sums, EnergyAccount& account, double parts) {
    LentEnergy& lent = chain.lent;
    const bool isFirst = lent.step != world.steps;
    if (isFirst && lent.step + 1 != world.steps) { lent = {}; }
    lent.step = world.steps;
    noteBalance(chain, sums, account, {.isFirst = isFirst, .parts = parts});
    if (chain.isDamped || chain.anchors == 0) {  // what those lose nothing gives back
        lent.energy = 0;
        return;
    }
    if (isFirst) { lent.energy *= kLentKept; }
    account.returned = std::min(lent.energy, kMostReturned * account.kinetic);
    lent.energy = std::max(0.0, lent.energy + account.work - account.gained);
}

void forget(JointChain& chain) {
    chain.lends = false;
    chain.lent = {};
}

/// Whether something that it holds is awake: what is stuck may sleep.
bool isInChain(const WorldState& world, const DrivenJoint& driven) {
    const Joint* const joint = world.joints.find(driven.joint);
    if (joint == nullptr || !world.jointTies[driven.joint.index].holds) { return false; }
    const auto bodies = joint->allBodies();
    return std::any_of(bodies.begin(), bodies.end(),
                       [&world](std::uint32_t slot) { return isAwakeDynamic(world, slot); });
}

/// Of the group of all that is solved together.
void noteLentOfAll(WorldState& world, const TiedGroup& group, Real time, double parts) {
    const SolveDesk& desk = group.desk;
    JointChains& chains = world.jointChains;
    for (JointChain& chain : chains.list) {
        chain.isDamped = false;
        const EnergyAccount& account = accountOf(world, chain.lowest);
        const bool isOff = !desk.isExact || account.gaveWay;
        chain.lends = chain.mayLend && account.solve == desk.energySolve && isOff;
    }
    for (const JointChains::Member& member : chains.members) {
        JointChain& chain = chains.list[chains.places[member.lowest]];
        if (!chain.lends) { continue; }
        chain.isDamped = chain.isDamped || isDamped(world, member.body);
        if (touches(world, member.body)) { forget(chain); }
    }
    for (const DrivenJoint& driven : world.drivenJoints) {
        if (!isInChain(world, driven)) { continue; }
        if (JointChain& chain = chainOf(world, driven.joint.index); chain.lends) { forget(chain); }
    }
    if (anyOf(chains.list, isSummedUp)) { addUpChains(world, group, time); }
    for (std::size_t i = 0; i < chains.list.size(); ++i) {
        JointChain& chain = chains.list[i];
        if (!chain.lends) { continue; }
        const ChainSums* const sums = isSummedUp(chain) ? &desk.chainSums[i] : nullptr;
        note(world, chain, sums, accountOf(world, chain.lowest), parts);
    }
}

/// Of an island that advances by itself.
void noteLentOfOne(WorldState& world, const TiedGroup& group, Real time, double parts) {
    const auto meets = [](const Contact& contact) { return !contact.sensor && contact.manifold.count > 0; };
    const auto touchesAny = [&world](std::uint32_t slot) {
        return isAwakeDynamic(world, slot) && touches(world, slot);
    };
    const auto mayLend = [&world](std::uint32_t joint) {
        return chainOf(world, joint).mayLend && (world.drivenJoints.empty() || !isDriven(world, joint));
    };
    const bool lends = std::none_of(group.contacts.begin(), group.contacts.end(), meets) &&
                       std::none_of(group.bodies.begin(), group.bodies.end(), touchesAny) &&
                       std::all_of(group.joints.begin(), group.joints.end(), mayLend);
    if (!lends) {
        for (const std::uint32_t joint : group.joints) { forget(chainOf(world, joint)); }
        return;
    }
    JointChain& chain = chainOf(world, group.joints.front());
    chain.lends = true;
    chain.isDamped = anyOf(
        group.bodies, [&world](std::uint32_t slot) { return isAwakeDynamic(world, slot) && isDamped(world, slot); });
    const bool isAsked = isSummedUp(chain);
    if (isAsked) { addUpChains(world, group, time); }
    note(world, chain, isAsked ? &group.desk.chainSums.front() : nullptr, accountOf(world, chain.lowest), parts);
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

void noteLent(WorldState& world, const TiedGroup& group, Real time, double dt) {
    if (group.desk.isExact && !group.desk.anyLeft) { return; }  // what is solved exactly opens no joints
    const double parts = dt / static_cast<double>(time);
    if (group.role == BodyRole::solved) {
        noteLentOfAll(world, group, time, parts);
    } else {
        noteLentOfOne(world, group, time, parts);
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
