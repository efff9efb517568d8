#include "contradictions.h"

#include <algorithm>

#include "../bodies/body_joints.h"
#include "../solve/energy_calm.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of an overlap, in extents: what joints do not hold there is pushed out sooner.
constexpr Real kDeep = Real(1) / 32;
/// Of the gap of a joint, in extents or radians: what can close did so in the step before.
constexpr Real kOff = Real(1) / 512;

bool isLoose(const JointChain& chain) { return chain.anchors == 0 && !chain.hasLoop(); }

/// @pre dynamic, both
bool areOfOneChain(const WorldState& world, const TouchingPair& pair) {
    if (world.bodies[pair.bodyA].holdingJoints == 0 || world.bodies[pair.bodyB].holdingJoints == 0) { return false; }
    const IslandFinder& chains = world.jointChains.finder;
    return chains.rootOf(pair.bodyA) == chains.rootOf(pair.bodyB);
}

void noteDeepContacts(WorldState& world) {
    for (const TouchingPair& pair : world.touching) {
        if (!pair.areDynamic() || !areOfOneChain(world, pair)) { continue; }
        const Contact& contact = world.contacts[pair.contact];
        if (!(deepestSeparation(contact.manifold) < -kDeep * contact.extent)) { continue; }
        world.islandLoads[world.islands.rootOf(pair.bodyA)].isContradicted = true;
    }
}

void noteJointsThatAreOff(WorldState& world) {
    for (const std::uint32_t index : world.activeJoints) {
        const JointTie& tie = world.jointTies[index];
        const std::uint32_t slot = dynamicBodyOf(world, tie);
        const JointChain& chain = world.jointChains.of(slot);
        IslandLoad& load = world.islandLoads[world.islands.rootOf(slot)];
        if (chain.doubled == 0 || !isLoose(chain) || load.contacts == 0) { continue; }
        load.isContradicted = load.isContradicted || gapOf(world, world.joints[index]) > kOff;
    }
}

}  // namespace

void noteContradictions(WorldState& world) {
    const std::vector<JointChain>& chains = world.jointChains.list;
    if (std::none_of(chains.begin(), chains.end(), isLoose)) { return; }
    noteDeepContacts(world);
    const auto isDoubled = [](const JointChain& chain) { return chain.doubled > 0 && isLoose(chain); };
    if (std::any_of(chains.begin(), chains.end(), isDoubled)) { noteJointsThatAreOff(world); }
}

}  // namespace swept::inline SWEPT_PRECISION
