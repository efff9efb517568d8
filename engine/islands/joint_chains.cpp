#include "joint_chains.h"

#include <algorithm>
#include <span>
#include <utility>

#include "../bodies/body_joints.h"
#include "../solve/lent_energy.h"
#include "../state/world_state.h"
#include "thin_loops.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of most only what all joints are asked first is looked at.
template <class Visit>
void forEachBodyOf(const WorldState& world, const JointTie& tie, std::uint32_t joint, const Visit& visit) {
    if (tie.isPair) {
        visit(tie.bodyA);
        visit(tie.bodyB);
        return;
    }
    for (const std::uint32_t body : world.joints[joint].allBodies()) { visit(body); }
}

/// All that hold something: where nothing sleeps, each has something dynamic.
void listAllJoints(WorldState& world) {
    for (std::uint32_t i = 0; i < world.jointTies.size(); ++i) {
        if (world.jointTies[i].holds) { world.activeJoints.push_back(i); }
    }
}

/// Those of what is awake, in the order of their slots: what follows costs nothing for those that sleep.
void listJointsOfAwake(WorldState& world) {
    for (const std::uint32_t slot : world.awake) {
        if (!isAwakeDynamic(world, slot)) { continue; }
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const JointTie& tie = world.jointTies[index];
            if (tie.holds && movingBodyOf(world, index) == slot) { world.activeJoints.push_back(index); }
        }
    }
    std::sort(world.activeJoints.begin(), world.activeJoints.end());
}

/// Of joints that hold something.
bool tieSleepers(const WorldState& world) {
    const auto sleeps = [&world](std::uint32_t slot) {
        if ((world.traits[slot] & kIsAwake) != 0) { return false; }
        const Body& body = world.bodies[slot];
        return !body.awake && body.def.type != BodyType::fixed;
    };
    return std::any_of(world.awake.begin(), world.awake.end(), [&](std::uint32_t slot) {
        const std::vector<std::uint32_t>& joints = world.bodies[slot].joints;
        return std::any_of(joints.begin(), joints.end(), [&](std::uint32_t index) {
            const JointTie& tie = world.jointTies[index];
            bool doesAny = false;
            forEachBodyOf(world, tie, index, [&](std::uint32_t body) { doesAny = doesAny || sleeps(body); });
            return tie.holds && doesAny;
        });
    });
}

void tieBodies(WorldState& world) {
    JointChains& chains = world.jointChains;
    chains.finder.reset(world.bodies.slotCount(), world.awake);
    for (const std::uint32_t i : world.activeJoints) {
        const JointTie& tie = world.jointTies[i];
        const std::uint32_t first = movingBodyOf(world, i);
        forEachBodyOf(world, tie, i, [&](std::uint32_t other) {
            if (isAwakeDynamic(world, other)) { chains.finder.unite(first, other); }
        });
    }
}

void listMembers(WorldState& world) {
    JointChains& chains = world.jointChains;
    for (const std::uint32_t slot : world.awake) {
        if (!isAwakeDynamic(world, slot) || world.bodies[slot].holdingJoints == 0) { continue; }
        chains.members.push_back({slot, chains.finder.find(slot)});
    }
    const auto isLower = [](const JointChains::Member& a, const JointChains::Member& b) { return a.body < b.body; };
    if (!std::is_sorted(chains.members.begin(), chains.members.end(), isLower)) {
        std::sort(chains.members.begin(), chains.members.end(), isLower);
    }
    chains.places.resize(world.bodies.slotCount());
    for (const JointChains::Member& member : chains.members) {
        if (member.lowest == member.body) {
            chains.places[member.lowest] = static_cast<std::uint32_t>(chains.list.size());
            chains.list.push_back({.lowest = member.lowest, .mayLend = true});
        }
        ++chains.list[chains.places[member.lowest]].bodies;
    }
}

void listBullets(WorldState& world) {
    for (const JointChains::Member& member : world.jointChains.members) {
        if (world.bodies[member.body].def.bullet) { world.jointChains.bullets.push_back(member.body); }
    }
}

bool tiesSameBodies(const JointTie& a, const JointTie& b) {
    return (a.bodyA == b.bodyA && a.bodyB == b.bodyB) || (a.bodyA == b.bodyB && a.bodyB == b.bodyA);
}

/// Whether one of a lower slot may close the same loops.
bool isDoubled(const WorldState& world, const JointTie& tie, std::uint32_t joint) {
    if (!tie.isPair) { return false; }
    const std::span<const std::uint32_t> others = fewerJoints(world, tie.bodyA, tie.bodyB);
    return std::any_of(others.begin(), others.end(), [&](std::uint32_t index) {
        const JointTie& other = world.jointTies[index];
        return index < joint && other.holds && other.isPair && !other.drivesAngleAlone && tiesSameBodies(tie, other);
    });
}

void sumUpJoints(WorldState& world) {
    JointChains& chains = world.jointChains;
    for (const std::uint32_t i : world.activeJoints) {
        const JointTie& tie = world.jointTies[i];
        JointChain& chain = chains.list[chains.places[chains.finder.find(movingBodyOf(world, i))]];
        ++chain.joints;
        chain.ties += tie.drivesAngleAlone ? 0 : 1;
        chain.doubled += !tie.drivesAngleAlone && isDoubled(world, tie, i) ? 1 : 0;
        chain.plainJoints += tie.isPlain ? 1 : 0;
        chain.softJoints += tie.isSoft ? 1 : 0;
        chain.jointsWithDrives += tie.hasDrives ? 1 : 0;
        chain.poweredJoints += tie.isPowered ? 1 : 0;
        chain.angleJoints += tie.holdsAngle ? 1 : 0;
        chain.limitedHinges += tie.isHinge && tie.hingeParts.hasLimits ? 1 : 0;
        chain.isPassive = chain.isPassive && tie.isPassive;
        chain.mayLend = chain.mayLend && tie.isPassive && !tie.isPowered && !tie.isSprung;
        bool areAllDynamic = true;
        forEachBodyOf(world, tie, i, [&](std::uint32_t slot) {
            if (isAwakeDynamic(world, slot)) { return; }
            const Body& body = world.bodies[slot];
            areAllDynamic = areAllDynamic && body.isDynamic();
            chain.mayLend = chain.mayLend && body.def.type == BodyType::fixed;
        });
        chain.anchors += areAllDynamic ? 0 : 1;
        chain.isAdrift = chain.isAdrift && areAllDynamic && tie.pushesInside;
    }
    chains.isAnyLoose = std::any_of(chains.list.begin(), chains.list.end(),
                                    [](const JointChain& chain) { return chain.isPassive && chain.anchors == 0; });
    chains.isAnyAdrift =
        std::any_of(chains.list.begin(), chains.list.end(), [](const JointChain& chain) { return chain.isAdrift; });
    for (JointChain& chain : chains.list) {
        chain.mayLend = chain.mayLend && (chain.anchors > 0 || chain.isAdrift);
        chains.mayAnyLend = chains.mayAnyLend || chain.mayLend;
    }
}

}  // namespace

void findJointChains(WorldState& world) {
    JointChains& chains = world.jointChains;
    world.activeJoints.clear();
    std::swap(chains.list, chains.before);
    chains.list.clear();
    chains.members.clear();
    chains.bullets.clear();
    chains.areCurrent = true;
    chains.tieSleepers = false;
    chains.isAnyLoose = false;
    chains.isAnyAdrift = false;
    chains.mayAnyLend = false;
    if (world.joints.size() == 0) { return; }
    if (anyAsleep(world)) {
        chains.tieSleepers = tieSleepers(world);
        listJointsOfAwake(world);
    } else {
        listAllJoints(world);
    }
    tieBodies(world);
    listMembers(world);
    if (world.bulletBodies > 0) { listBullets(world); }
    sumUpJoints(world);
    if (chains.mayAnyLend) { keepLent(world); }
    chains.before.clear();
    findThinLoops(world);
}

}  // namespace swept::inline SWEPT_PRECISION
