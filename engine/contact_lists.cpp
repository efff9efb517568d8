#include "contact_lists.h"

#include <algorithm>

#include "pair_boxes.h"
#include "travel.h"
#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Probes per block, each of which one worker lists: enough work to pay for handing it over.
constexpr std::size_t kProbesPerBlock = 256;

/// What all probes of a step are asked with.
struct Question {
    std::span<const Aabb> boxes;
    Real dt = 0;
    bool isAllAwake = false;  ///< all bodies are that are not static: then most contacts need not ask theirs
};

Question questionOf(const WorldState& world) {
    return {world.broadphase->boxes(), static_cast<Real>(world.lastDt),
            world.awake.size() + world.fixedBodies == world.bodies.size()};
}

/// @tparam kWatched  speculative bodies reach farther than was noted
template <bool kWatched>
ContactState stateOf(const WorldState& world, const Question& question, const ContactProbe& probe) {
    const BodyGlances bodies{world.glances[probe.bodyA], world.glances[probe.bodyB]};
    const bool isAwake = (question.isAllAwake && probe.isPlain) || bodies.a.isAwake() || bodies.b.isAwake();
    if (!isAwake) { return ContactState::asleep; }
    if (!boxesOverlap(question.boxes, probe)) { return ContactState::boxesApart; }
    if (kWatched || !probe.isIdle) { return ContactState::near; }
    if (!boxesOverlap(world.neededBoxes, probe) || bodies.areFar()) { return ContactState::apart; }
    return bodies.stateOfIdle(probe, question.dt);
}

bool isNoted(const ContactProbe& probe, ContactState state) {
    return state == ContactState::asleep ? !probe.isIdle : state != ContactState::apart;
}

/// @param noted  room for all of the block
/// @return how many are noted
template <bool kWatched>
std::uint32_t listBlock(WorldState& world, const Question& question, std::size_t begin, std::size_t end,
                        std::uint32_t* noted) {
    std::uint32_t count = 0;
    for (std::size_t i = begin; i < end; ++i) {
        ContactProbe& probe = world.probes[i];
        const ContactState state = stateOf<kWatched>(world, question, probe);
        if (!isNoted(probe, state)) { continue; }
        if (probe.state != state) { probe.state = state; }  // else its cache line need not go back to memory
        noted[count++] = static_cast<std::uint32_t>(i);
    }
    return count;
}

template <bool kWatched>
void listBlocks(WorldState& world) {
    ContactLists& lists = world.lists;
    const Question question = questionOf(world);
    const std::size_t count = world.activeContacts;
    const std::size_t blocks = (count + kProbesPerBlock - 1) / kProbesPerBlock;
    lists.noted.resize(count);
    lists.counts.resize(blocks);
    world.loops->run(blocks, 1, [&world, &lists, &question, count](std::size_t first, std::size_t last, int) {
        for (std::size_t block = first; block < last; ++block) {
            const std::size_t begin = block * kProbesPerBlock;
            lists.counts[block] = listBlock<kWatched>(world, question, begin, std::min(begin + kProbesPerBlock, count),
                                                      lists.noted.data() + begin);
        }
    });
}

/// One block behind the other, and each contact in the lists of what is to be done for it.
void joinBlocks(WorldState& world) {
    ContactLists& lists = world.lists;
    lists.clear();
    std::size_t size = 0;
    for (std::size_t block = 0; block < lists.counts.size(); ++block) {
        for (std::size_t i = block * kProbesPerBlock; i < block * kProbesPerBlock + lists.counts[block]; ++i) {
            const std::uint32_t place = lists.noted[size++] = lists.noted[i];
            const ContactProbe& probe = world.probes[place];
            if (probe.state == ContactState::boxesApart) { lists.apart.push_back(place); }
            if (probe.state != ContactState::near) { continue; }
            lists.near.push_back(place);
            if (!probe.isPlain) { lists.ground.push_back(probe.contact); }
        }
    }
    lists.noted.resize(size);
}

}  // namespace

void listContacts(WorldState& world) {
    if (world.watched) {
        listBlocks<true>(world);
    } else {
        listBlocks<false>(world);
    }
    joinBlocks(world);
}

}  // namespace swept::inline SWEPT_PRECISION
