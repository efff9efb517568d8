#include "thin_loops.h"

#include <algorithm>
#include <cstddef>

#include "../bodies/body_joints.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Blocks of the factor for each body. What costs is their number times how many stand in a column. Rings, ladders and
/// trusses, at any length, have up to 2, nets of three in a row 2.8 to 3, of ten 5.6. (Measured:
/// solver/MEASURED.md, "Trusses"; `Nets.LongTrussesStandHoweverLong`.)
constexpr std::size_t kMostBlocksOfThin = 2;

bool mayBeThin(const JointChain& chain) {
    return chain.bodies > kMostLoopBodies && chain.bodies <= kMostThinBodies && chain.plainJoints == chain.joints &&
           chain.hasLoop();
}

void numberBodies(JointChains& chains, ThinLoops& scratch) {
    scratch.numbers.resize(chains.places.size());
    scratch.counts.assign(chains.list.size(), 0);
    for (const JointChains::Member& member : chains.members) {
        scratch.numbers[member.body] = scratch.counts[chains.places[member.lowest]]++;
    }
}

/// Chain by chain.
void listTies(WorldState& world, ThinLoops& scratch) {
    JointChains& chains = world.jointChains;
    scratch.ties.clear();
    for (const std::uint32_t i : world.activeJoints) {
        const JointTie& tie = world.jointTies[i];
        if (!tie.isPair || !isAwakeDynamic(world, tie.bodyA) || !isAwakeDynamic(world, tie.bodyB)) { continue; }
        const std::uint32_t chain = chains.places[chains.finder.find(tie.bodyA)];
        if (!mayBeThin(chains.list[chain])) { continue; }
        scratch.ties.push_back({chain, {scratch.numbers[tie.bodyA], scratch.numbers[tie.bodyB]}});
    }
    std::stable_sort(scratch.ties.begin(), scratch.ties.end(),
                     [](const ThinLoops::Tie& a, const ThinLoops::Tie& b) { return a.chain < b.chain; });
}

}  // namespace

void findThinLoops(WorldState& world) {
    JointChains& chains = world.jointChains;
    if (std::none_of(chains.list.begin(), chains.list.end(), mayBeThin)) { return; }
    ThinLoops& scratch = chains.thinLoops;
    numberBodies(chains, scratch);
    listTies(world, scratch);
    for (std::size_t begin = 0; begin < scratch.ties.size();) {
        JointChain& chain = chains.list[scratch.ties[begin].chain];
        scratch.edges.clear();
        std::size_t end = begin;
        for (; end < scratch.ties.size() && scratch.ties[end].chain == scratch.ties[begin].chain; ++end) {
            scratch.edges.push_back(scratch.ties[end].bodies);
        }
        chain.isThin = scratch.factor.analyse(chain.bodies, scratch.edges, kMostBlocksOfThin * chain.bodies);
        begin = end;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
