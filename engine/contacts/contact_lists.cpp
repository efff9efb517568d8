#include "contact_lists.h"

#include <algorithm>

#include "../bodies/travel.h"
#include "../crew/beside.h"
#include "../crew/join_blocks.h"
#include "../state/world_state.h"
#include "candidates.h"
#include "pair_boxes.h"

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
    return {world.broadphase->boxes(), static_cast<Real>(world.lastDt), areAllUp(world)};
}

/// @tparam kWatched  speculative bodies reach farther than was noted
template <bool kWatched>
ContactState stateOf(const WorldState& world, const Question& question, const ContactProbe& probe) {
    const BodyGlances bodies{world.glances[probe.bodyA], world.glances[probe.bodyB]};
    const bool isAwake = (question.isAllAwake && probe.isPlain) || bodies.a.isAwake() || bodies.b.isAwake();
    if (!isAwake && !probe.isUnseen) { return ContactState::asleep; }
    if (!boxesOverlap(question.boxes, probe)) { return ContactState::boxesApart; }
    if (kWatched || !probe.isIdle) { return ContactState::near; }
    if (!boxesOverlap(world.neededBoxes, probe) || bodies.areFar()) { return ContactState::apart; }
    return bodies.stateOfIdle(probe, question.dt);
}

bool isNoted(const ContactProbe& probe, ContactState state) {
    return state == ContactState::asleep ? !probe.isIdle : state != ContactState::apart;
}

/// Lists the probes of a block at the place that the first of them would have if all were listed.
template <bool kWatched>
ContactLists::Counts listBlock(WorldState& world, const Question& question, std::size_t begin, std::size_t end) {
    ContactLists::Counts counts;
    std::uint32_t* const noted = world.lists.noted.data() + begin;
    std::uint32_t* const near = world.lists.near.data() + begin;
    const std::span<ContactProbe> probes = world.probes;
    for (std::size_t i = begin; i < end; ++i) {
        ContactProbe& probe = probes[i];
        const ContactState state = stateOf<kWatched>(world, question, probe);
        if (!isNoted(probe, state)) { continue; }
        if (probe.state != state) { probe.state = state; }  // else its cache line need not go back to memory
        const auto place = static_cast<std::uint32_t>(i);
        noted[counts.noted++] = place;
        if (state == ContactState::near) {
            near[counts.near++] = place;
            if (!probe.isPlain) { world.lists.ground[begin + counts.ground++] = probe.contact; }
        } else if (state == ContactState::boxesApart) {
            world.lists.apart[begin + counts.apart++] = place;
        }
    }
    return counts;
}

template <bool kWatched>
void listBlocks(WorldState& world) {
    ContactLists& lists = world.lists;
    const Question question = questionOf(world);
    const std::size_t count = world.probes.size();
    const std::size_t blocks = (count + kProbesPerBlock - 1) / kProbesPerBlock;
    for (auto* const list : {&lists.noted, &lists.near, &lists.ground, &lists.apart}) { list->resize(count); }
    lists.counts.resize(blocks);
    const auto listSome = [&world, &lists, &question, count](std::size_t first, std::size_t last) {
        for (std::size_t block = first; block < last; ++block) {
            const std::size_t begin = block * kProbesPerBlock;
            lists.counts[block] = listBlock<kWatched>(world, question, begin, std::min(begin + kProbesPerBlock, count));
        }
    };
    runBeside(
        *world.loops, [&world] { closeCandidates(world); }, blocks, 1, listSome);
}

void join(const ContactLists& lists, std::uint32_t ContactLists::Counts::*count, RawVector<std::uint32_t>& list) {
    joinBlocks(list, lists.counts.size(), kProbesPerBlock,
               [&lists, count](std::size_t block) { return lists.counts[block].*count; });
}

}  // namespace

void listContacts(WorldState& world) {
    if (world.watched) {
        listBlocks<true>(world);
    } else {
        listBlocks<false>(world);
    }
    ContactLists& lists = world.lists;
    join(lists, &ContactLists::Counts::noted, lists.noted);
    join(lists, &ContactLists::Counts::near, lists.near);
    join(lists, &ContactLists::Counts::ground, lists.ground);
    join(lists, &ContactLists::Counts::apart, lists.apart);
    lists.passing.clear();
}

}  // namespace swept::inline SWEPT_PRECISION
