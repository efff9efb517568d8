#include <algorithm>

#include "../contacts/contact_fetch.h"
#include "../contacts/contact_tests.h"
#include "../contacts/ghosts.h"
#include "../crew/join_blocks.h"
#include "../modes/modes.h"
#include "step.h"
#include "waking.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Noted probes per block, each of which one worker lists.
constexpr std::size_t kNotedPerBlock = 512;

ContactEvent eventOf(const WorldState& world, const Contact& contact, bool begins) {
    ContactEvent event;
    if (contact.sensor) {
        event.type = begins ? ContactEventType::sensorBegin : ContactEventType::sensorEnd;
    } else {
        event.type = begins ? ContactEventType::begin : ContactEventType::end;
    }
    event.shapeA = world.shapes.idOf(world.shapes[contact.shapeA].head);
    event.shapeB = world.shapes.idOf(world.shapes[contact.shapeB].head);
    event.bodyA = world.bodies.idOf(contact.bodyA);
    event.bodyB = world.bodies.idOf(contact.bodyB);
    if (contact.sensor || contact.manifold.count > 0) {
        const WorldTransform& pose = world.motions[contact.bodyA].pose;
        event.point = apply(pose, contact.manifold.points[0].point);
        event.normal = rotate(pose.rotation, contact.manifold.normal);
    }
    return event;
}

/// In order of the contacts: events, and waking of what an awake body touches.
void noticeTouching(WorldState& world, Contact& contact) {
    const bool touching = isTouching(contact);
    if (touching != contact.touching) {
        world.contactEvents.push_back(eventOf(world, contact, touching));
        contact.touching = touching;
    }
    if (!contact.isSolid()) { return; }
    const bool sleepsA = contact.dynamicA && !isUp(world, contact.bodyA);
    const bool sleepsB = contact.dynamicB && !isUp(world, contact.bodyB);
    if (!sleepsA && !sleepsB) { return; }
    if (disturbs(world, contact.bodyA) && world.bodies[contact.bodyB].isDynamic()) { wake(world, contact.bodyB); }
    if (disturbs(world, contact.bodyB) && world.bodies[contact.bodyA].isDynamic()) { wake(world, contact.bodyA); }
}

bool isDeep(const Contact& contact) { return deepestSeparation(contact.manifold) < -kShallowRatio * contact.extent; }

bool isOpen(const Contact& contact) { return deepestSeparation(contact.manifold) > kEndRatio * contact.extent; }

TouchingPair touchingPair(const Contact& contact, std::uint32_t place) {
    const TouchTraits traits{.points = static_cast<std::uint8_t>(contact.manifold.count),
                             .dynamicA = contact.dynamicA,
                             .dynamicB = contact.dynamicB,
                             .bounces = contact.restitution > 0,
                             .isBelt = contact.isBelt,
                             .resistsRolling = contact.resistsRolling,
                             .isOpen = isOpen(contact),
                             .mayMeet = !contact.touching,
                             .isDeep = !(contact.dynamicA && contact.dynamicB) && isDeep(contact)};
    return {traits, place, contact.bodyA, contact.bodyB};
}

/// Of what `isTold`.
TouchingPair touchingPair(const ContactProbe& probe) { return {probe, probe.contact, probe.bodyA, probe.bodyB}; }

/// Few contacts lose their points to others of the same body: their probes tell what they had before.
void distrustGhosts(WorldState& world) {
    for (const std::uint32_t i : world.lists.near) {
        ContactProbe& probe = world.probes[i];
        if (!probe.isPlain && probe.points > 0 && !world.contacts[probe.contact].isSolid()) { probe.areUp = false; }
    }
}

/// Whether the probe of a contact tells all: mostly.
bool isTold(const ContactProbe& probe) {
    return (int{probe.state == ContactState::near} & int{probe.areUp} & int{!probe.turns}) != 0;
}

/// Of another one: whether its contact is asked.
bool mayHavePoints(const ContactProbe& probe) {
    return probe.state == ContactState::near || probe.state == ContactState::asleep;
}

/// Of a contact whose manifold is new, or which sleeps with points. @return whether it has some
bool noticeOther(WorldState& world, ContactProbe& probe) {
    Contact& contact = world.contacts[probe.contact];
    if (probe.state == ContactState::near) {
        noticeTouching(world, contact);
        probe.isIdle = contact.manifold.count == 0 && !contact.sensor;
    }
    return contact.isSolid();
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

void listUnparked(WorldState& world) {
    const std::size_t count = unparkContacts(world);
    for (const ContactProbe& probe : std::span(world.probes).last(count)) {
        const Contact& contact = world.contacts[probe.contact];
        if (contact.isSolid()) { world.touching.push_back(touchingPair(contact, probe.contact)); }
    }
}

void listHemmed(WorldState& world, std::span<const std::uint32_t> probes) {
    const std::size_t before = world.touching.size();
    for (const std::uint32_t place : probes) {
        ContactProbe& probe = world.probes[place];
        probe.state = ContactState::near;
        if (isTold(probe)) {
            probe.isIdle = probe.points == 0;
            if (!probe.isIdle) { world.touching.push_back(touchingPair(probe)); }
        } else if (noticeOther(world, probe)) {
            world.touching.push_back(touchingPair(world.contacts[probe.contact], probe.contact));
        }
    }
    world.counters.touching += world.touching.size() - before;
}

void listTouching(WorldState& world) {
    if (!hasContacts(world)) { return; }
    const bool anyGhost = dropGhosts(world, world.contacts, world.slides, world.lists.ground, world.awake,
                                     world.nextGroundContact, *world.loops);
    if (anyGhost || !world.chainPassers.empty()) { distrustGhosts(world); }
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
