#include <algorithm>

#include "../bodies/travel.h"
#include "../contacts/contact_fetch.h"
#include "../contacts/contact_making.h"
#include "../contacts/contact_tests.h"
#include "../contacts/decks.h"
#include "../contacts/ghosts.h"
#include "../contacts/noticing.h"
#include "../contacts/pairs_of_shapes.h"
#include "../crew/join_blocks.h"
#include "../modes/modes.h"
#include "step.h"
#include "waking.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Noted probes per block, each of which one worker lists.
constexpr std::size_t kNotedPerBlock = 512;

/// Few contacts lose their points to others of the same body, or get other ones: their probes tell what they had
/// before.
void distrustGhosts(WorldState& world) {
    for (const std::uint32_t i : world.lists.near) {
        ContactProbe& probe = world.probes[i];
        if (probe.isPlain || probe.points == 0) { continue; }
        const Contact& contact = world.contacts[probe.contact];
        const TouchTraits now = touchingPair(contact, probe.contact);
        const bool isAsTold = now.points == probe.points && now.isOpen == probe.isOpen && now.isDeep == probe.isDeep;
        if (!contact.isSolid() || !isAsTold || isTouching(contact) != contact.touching) { probe.areUp = false; }
    }
}

/// Of another one: whether its contact is asked.
bool mayHavePoints(const ContactProbe& probe) {
    return probe.state == ContactState::near || probe.state == ContactState::asleep;
}

/// Of a block of noted probes: those that are told with points go to the place that the first of them would have if all
/// had some, and for those that must be asked one stays free.
ContactLists::Listed listTold(WorldState& world, std::size_t begin, std::size_t end) {
    ContactLists& lists = world.lists;
    ContactLists::Listed listed;
    const std::span<ContactProbe> probes = world.probes;
    for (std::size_t i = begin; i < end; ++i) {
        ContactProbe& probe = probes[lists.noted[i]];
        if (isTold(probe)) {
            probe.isIdle = probe.points == 0;
            if (!probe.isIdle) { world.touching[begin + listed.pairs++] = touchingPair(probe); }
        } else if (probe.state != ContactState::boxesApart) {
            const auto place = static_cast<std::uint32_t>(begin + listed.pairs);
            lists.others[begin + listed.others++] = {lists.noted[i], place};
            listed.pairs += mayHavePoints(probe) ? 1 : 0;
        }
    }
    return listed;
}

/// Those that have to be asked, in order. What turns out to have no points keeps its place, with none.
void noticeOthers(WorldState& world) {
    const std::span<const ContactLists::Other> others = world.lists.others;
    for (std::size_t i = 0; i < others.size(); ++i) {
        fetchForEvents(world, others.subspan(i));
        const ContactLists::Other& other = others[i];
        ContactProbe& probe = world.probes[other.probe];
        if (!mayHavePoints(probe)) {
            world.lists.passing.push_back(other.probe);
            continue;
        }
        TouchingPair& pair = world.touching[other.place];
        if (noticeOther(world, probe)) {
            pair = touchingPair(world.contacts[probe.contact], probe.contact);
        } else {
            pair.points = 0;
            world.lists.isAnyFree = true;
        }
    }
}

/// So that the pairs that touch stand side by side.
void closeFreePlaces(WorldState& world) {
    const ContactLists& lists = world.lists;
    joinBlocks(world.touching, lists.listed.size(), lists.listedPerBlock,
               [&lists](std::size_t block) { return lists.listed[block].pairs; });
    if (!lists.isAnyFree) { return; }
    std::erase_if(world.touching, [](const TouchingPair& pair) { return pair.points == 0; });
}

/// Removes the contacts whose boxes came apart (`ContactState`).
void removeApartContacts(WorldState& world) {
    const std::span<const std::uint32_t> apart = world.lists.apart;
    if (apart.empty()) { return; }
    std::vector<ContactProbe>& probes = world.probes;
    const auto at = [&probes](std::size_t place) { return probes.begin() + static_cast<std::ptrdiff_t>(place); };
    world.droppedPairs.clear();
    auto kept = at(apart.front());
    for (std::size_t i = 0; i < apart.size(); ++i) {
        world.droppedPairs.push_back(probes[apart[i]]);
        reportEnd(world, probes[apart[i]], world.contactEvents);
        kept = std::copy(at(apart[i] + 1), at(i + 1 < apart.size() ? apart[i + 1] : probes.size()), kept);
    }
    probes.resize(probes.size() - apart.size());
    dropPairs(world, world.droppedPairs);
}

void countAhead(WorldState& world) {
    for (const std::uint32_t i : world.lists.near) {
        const Contact& contact = world.contacts[world.probes[i].contact];
        world.counters.aheadContacts += contact.isSolid() && isAhead(world, contact) ? 1 : 0;
    }
}

void countContacts(WorldState& world) {
    world.counters.contacts =
        world.probes.size() + world.candidates.size() + world.parked.probes.size() + world.parked.candidates.size();
    world.counters.touching = world.touching.size() + world.parked.touching;
}

}  // namespace

void listTouching(WorldState& world) {
    if (!hasContacts(world)) { return; }
    const bool anyGhost = dropGhosts(world, world.contacts, world.slides, world.lists.ground, world.awake,
                                     world.nextGroundContact, *world.loops);
    if (anyGhost || !world.chainPassers.empty()) { distrustGhosts(world); }
    dropGhostsOfDecks(world);
    ContactLists& lists = world.lists;
    const std::size_t count = lists.noted.size();
    world.touching.resize(count);
    lists.others.resize(count);
    lists.isAnyFree = false;
    // Alone it lists all at once, and nothing has to be joined.
    lists.listedPerBlock = world.loops->workerCount() > 1 ? kNotedPerBlock : std::max(count, std::size_t{1});
    lists.listed.resize((count + lists.listedPerBlock - 1) / lists.listedPerBlock);
    world.loops->run(lists.listed.size(), 1, [&world, &lists, count](std::size_t first, std::size_t last, int) {
        for (std::size_t block = first; block < last; ++block) {
            const std::size_t begin = block * lists.listedPerBlock;
            lists.listed[block] = listTold(world, begin, std::min(begin + lists.listedPerBlock, count));
        }
    });
    joinBlocks(lists.others, lists.listed.size(), lists.listedPerBlock,
               [&lists](std::size_t block) { return lists.listed[block].others; });
}

void noticeContacts(WorldState& world) {
    const bool haveContacts = hasContacts(world);
    const bool mayJointsWake = !world.jointChains.areCurrent || world.jointChains.tieSleepers;
    if (mayJointsWake && world.joints.size() > 0 && anyAsleep(world)) { wakeAcrossJoints(world, 0); }
    const std::size_t before = world.awake.size();
    if (haveContacts) {
        if (world.watched) { countAhead(world); }
        noticeOthers(world);
        closeFreePlaces(world);
        removeApartContacts(world);
    }
    wakeOnward(world, before);
    if (!world.parked.woken.empty()) { listUnparked(world); }
    countContacts(world);
}

}  // namespace swept::inline SWEPT_PRECISION
