#include <algorithm>

#include "../advance/first_try.h"
#include "../advance/island_advance.h"
#include "../advance/island_contacts.h"
#include "../bodies/body_joints.h"
#include "../contacts/candidates.h"
#include "../containers/any_of.h"
#include "../flight/bullet_start.h"
#include "../flight/bullets_ahead.h"
#include "../flight/clash.h"
#include "../flight/flight_traces.h"
#include "../flight/ground_on_the_way.h"
#include "../islands/effort_trial.h"
#include "../modes/modes.h"
#include "../solve/lent_energy.h"
#include "../solve/solve_desk.h"
#include "../solve/solve_outcome.h"
#include "../state/profile.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// @param slot  of a body that is tied to others
bool isFastTied(const WorldState& world, std::uint32_t slot) {
    return (world.traits[slot] & kIsFast) != 0 && modeOf(world, world.bodies[slot]) == ContinuousMode::subStep;
}

/// Bodies per block of a parallel loop.
constexpr std::size_t kMemberGrain = 256;

/// Of each island.
void countMembers(WorldState& world) {
    std::vector<std::uint32_t>& members = world.fastIslands.members;
    members.resize(world.bodies.slotCount());
    for (const std::uint32_t root : world.tiedRoots) { members[root] = 0; }
    for (const std::uint32_t root : world.tiedRoots) { ++members[root]; }
}

/// Those of the last such step.
void forgetNumbers(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    for (const std::uint32_t slot : fast.bodies.all()) { fast.numbers[slot] = kNoIndex; }
    fast.numbers.resize(world.bodies.slotCount(), kNoIndex);
}

/// Numbers the islands with something fast by their lowest members, which stand for them in `world.islands`. Islands
/// that are too large for it stay with the others.
void numberIslands(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    const auto isFast = [&world](std::uint32_t slot) { return isFastTied(world, slot); };
    if (noneOf(world.tied, isFast)) { return; }
    countMembers(world);
    forgetNumbers(world);
    std::vector<std::uint32_t>& roots = fast.roots;
    roots.clear();
    for (std::size_t i = 0; i < world.tied.size(); ++i) {
        const std::uint32_t slot = world.tied[i];
        if ((world.traits[slot] & kIsFast) == 0) { continue; }
        const std::uint32_t root = world.tiedRoots[i];
        if (fast.members[root] > mostTogether(world.settings) || fast.numbers[root] != kNoIndex) { continue; }
        if (!isFast(slot)) { continue; }  // last, since a body has to be fetched for it
        fast.numbers[root] = 0;
        roots.push_back(root);
    }
    fast.any = !roots.empty();
    std::sort(roots.begin(), roots.end());
    for (std::uint32_t i = 0; i < roots.size(); ++i) { fast.numbers[roots[i]] = i; }
    fast.clashes.assign(roots.size(), ClashEnd::none);
}

/// Gives all bodies of the islands the role `together`, and the number of their island.
void listBodies(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.bodies.clear();
    for (std::size_t i = 0; i < world.tied.size(); ++i) {
        const std::uint32_t number = fast.numbers[world.tiedRoots[i]];
        if (number == kNoIndex) { continue; }
        const std::uint32_t slot = world.tied[i];
        fast.numbers[slot] = number;
        fast.bodies.add(number, slot);
    }
    fast.bodies.sort(fast.clashes.size());
    const std::span<const std::uint32_t> members = fast.bodies.all();
    world.loops->run(members.size(), kMemberGrain, [&world, members](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { world.bodies[members[i]].role = BodyRole::together; }
    });
}

/// Whether one of the two is swept against the other members of its island (member_meetings.h).
bool mayMeetMember(const WorldState& world, std::uint32_t bodyA, std::uint32_t bodyB) {
    if (world.jointChains.bullets.empty() && world.bulletWork.whirls.empty()) { return false; }
    return meetsMembers(world, bodyA) || meetsMembers(world, bodyB);
}

/// What bounces off another one in flight, or is a bullet that rides on it, may meet any other member of its island
/// then, in whatever direction that was.
void promoteClashing(WorldState& world) {
    if (world.bouncyShapes == 0 && world.bullets == 0) { return; }
    const FastIslands& fast = world.fastIslands;
    promoteCandidatesOf(world, [&](const ContactPair& pair) {
        const std::uint32_t number = fast.numbers[pair.bodyA];
        return number != kNoIndex && number == fast.numbers[pair.bodyB] &&
               (fast.bodies.of(number).size() <= kMostClashing || mayMeetMember(world, pair.bodyA, pair.bodyB));
    });
}

bool isSensor(const WorldState& world, const ContactProbe& probe) {
    return !probe.isPlain && world.contacts[probe.contact].sensor;
}

/// Probes per block, each of which one worker lists.
constexpr std::size_t kFastProbesPerBlock = 1024;

void listContactsOfBlock(const WorldState& world, std::uint32_t begin, std::uint32_t end,
                         std::vector<IslandItems::Added>& contacts) {
    const std::span<const std::uint32_t> numbers = world.fastIslands.numbers;
    const bool mayClash = world.bouncyShapes > 0 || world.bullets > 0;
    contacts.clear();
    for (std::uint32_t i = begin; i < end; ++i) {
        const ContactProbe& probe = world.probes[i];
        if (!mayClash && probe.isPlain && probe.isIdle) { continue; }  // see `isInside`
        const std::uint32_t ofA = numbers[probe.bodyA];
        const std::uint32_t number = ofA != kNoIndex ? ofA : numbers[probe.bodyB];
        if (number != kNoIndex && !isSensor(world, probe)) { contacts.push_back({number, i}); }
    }
}

void listFastContacts(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    const std::size_t count = world.probes.size();
    const std::size_t blocks = (count + kFastProbesPerBlock - 1) / kFastProbesPerBlock;
    fast.contactsOfBlocks.resize(std::max(blocks, fast.contactsOfBlocks.size()));
    world.loops->run(blocks, 1, [&](std::size_t first, std::size_t last, int) {
        for (std::size_t block = first; block < last; ++block) {
            const std::size_t begin = block * kFastProbesPerBlock;
            const std::size_t end = std::min(begin + kFastProbesPerBlock, count);
            listContactsOfBlock(world, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
                                fast.contactsOfBlocks[block]);
        }
    });
    fast.contacts.clear();
    for (std::size_t block = 0; block < blocks; ++block) { fast.contacts.add(fast.contactsOfBlocks[block]); }
    fast.contacts.sort(fast.clashes.size());
}

void listFastJoints(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.joints.clear();
    for (const std::uint32_t i : world.activeJoints) {
        const std::uint32_t number = fast.numbers[movingBodyOf(world, i)];
        if (number != kNoIndex) { fast.joints.add(number, i); }
    }
    fast.joints.sort(fast.clashes.size());
}

/// Islands per task: each has several sweeps.
constexpr std::size_t kClashGrain = 2;
/// Each is solved at least once.
constexpr std::size_t kIslandGrain = 1;

/// What bounces off each other in flight.
void clashAll(WorldState& world, double dt) {
    FastIslands& fast = world.fastIslands;
    if (world.bullets > 0) { world.bulletWork.farthest = farthestOf(world, static_cast<Real>(dt)); }
    const auto workers = static_cast<std::size_t>(world.loops->workerCount());
    world.flightScratch.resize(std::max(workers, world.flightScratch.size()));
    world.clashScratch.resize(std::max(workers, world.clashScratch.size()));
    world.loops->run(fast.clashes.size(), kClashGrain, [&](std::size_t begin, std::size_t end, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        for (std::size_t i = begin; i < end; ++i) {
            if (!fast.joints.of(i).empty()) { continue; }
            fast.clashes[i] =
                clash(world, fast.bodies.of(i), fast.contacts.of(i), dt, world.flightScratch[w], world.clashScratch[w]);
        }
    });
}

/// Their members fly by themselves, in order of time with all that bullets meet (bullets.h).
void dissolveClashes(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    for (std::uint32_t island = 0; island < fast.clashes.size(); ++island) {
        if (fast.clashes[island] != ClashEnd::dissolved) { continue; }
        fast.anyDissolved = true;
        for (const std::uint32_t slot : fast.bodies.of(island)) {
            world.bodies[slot].role = BodyRole::flyer;
            world.flyers.push_back(slot);
        }
        for (const std::uint32_t index : fast.contacts.of(island)) {
            Contact& contact = world.contacts[world.probes[index].contact];
            contact.normalImpulse = contact.tangentImpulse = contact.totalImpulse = {};
            contact.pressed = false;
        }
    }
}

/// Contacts of dynamic bodies of two islands (a member that touches nothing yet) stay with the first; those are left
/// out.
bool isInside(const WorldState& world, const Contact& contact) {
    const Body& a = world.bodies[contact.bodyA];
    const Body& b = world.bodies[contact.bodyB];
    return !a.isDynamic() || !b.isDynamic() || contact.isSolid();
}

/// What does not touch yet, and comes to do so where the bullet meets it.
bool mayMeet(const WorldState& world, const Contact& contact) {
    const std::vector<std::uint32_t>& numbers = world.fastIslands.numbers;
    return numbers[contact.bodyA] == numbers[contact.bodyB] && mayMeetMember(world, contact.bodyA, contact.bodyB);
}

void gather(WorldState& world, AdvancingIsland& fast, std::size_t island) {
    const FastIslands& islands = world.fastIslands;
    const std::span<const std::uint32_t> bodies = islands.bodies.of(island);
    fast.members.assign(bodies.begin(), bodies.end());
    const std::span<const std::uint32_t> joints = islands.joints.of(island);
    fast.jointSlots.assign(joints.begin(), joints.end());
    fast.contacts.clear();
    fast.sources.clear();
    fast.sourceProbes.clear();
    fast.pointsBefore.clear();
    const bool mayMeetOthers = mayMembersMeet(world, bodies);
    for (const std::uint32_t index : islands.contacts.of(island)) {
        const std::uint32_t source = world.probes[index].contact;
        const Contact& contact = world.contacts[source];
        if (!isInside(world, contact) && !(mayMeetOthers && mayMeet(world, contact))) { continue; }
        fast.contacts.push_back(world.contacts[source]);
        fast.sources.push_back(source);
        fast.sourceProbes.push_back(index);
    }
}

/// What an island leaves of a step outside of itself.
struct IslandTraces {
    std::size_t events = 0;
    std::size_t found = 0;
    FlightTraces flights;
};
IslandTraces tracesOf(const IslandDesk& desk, const FlightScratch& scratch) {
    return {.events = desk.events.size(), .found = desk.found.size(), .flights = tracesOf(scratch)};
}

/// As the island was before it advanced, but for the effort of its members.
void takeBack(WorldState& world, IslandDesk& desk, const IslandTraces& before, FlightScratch& scratch) {
    const AdvancingIsland& fast = desk.island;
    const EffortTrial& trial = world.trial;
    for (std::size_t i = 0; i < fast.members.size(); ++i) {
        restore(world, fast.members[i], fast.membersAtStart[i]);
        world.bodies[fast.members[i]].sunk = fast.membersAtStart[i].sunk;  // it may come another way
    }
    for (std::size_t i = 0; i < trial.fastContacts.size(); ++i) {
        world.contacts[fast.sources[i]] = trial.fastContacts[i];
    }
    for (std::size_t i = 0; i < fast.jointSlots.size(); ++i) { world.joints[fast.jointSlots[i]] = trial.joints[i]; }
    if (LentEnergy* const lent = lentOf(world, fast.jointSlots)) { *lent = fast.lentAtStart; }
    cutTo(desk.events, before.events);
    cutTo(desk.found, before.found);
    cutTo(scratch, before.flights);
}

/// One after the other.
void advanceWithinBudget(WorldState& world, IslandDesk& desk, std::size_t island, double dt, FlightScratch& scratch) {
    AdvancingIsland& fast = desk.island;
    world.trial.joints.clear();
    for (const std::uint32_t slot : fast.jointSlots) { world.trial.joints.push_back(world.joints[slot]); }
    world.trial.fastContacts = fast.contacts;
    const IslandTraces before = tracesOf(desk, scratch);
    advanceIsland(world, desk, dt, scratch);
    while (raiseMissedJoints(world, fast.members, fast.jointSlots, dt)) {
        takeBack(world, desk, before, scratch);
        gather(world, fast, island);
        advanceIsland(world, desk, dt, scratch);
    }
}

void advanceOne(WorldState& world, IslandDesk& desk, std::size_t island, double dt, FlightScratch& scratch) {
    const FastIslands& islands = world.fastIslands;
    gather(world, desk.island, island);
    const bool isTried = hasErrorBudget(world.settings) && !islands.joints.of(island).empty();
    if (isTried) {
        advanceWithinBudget(world, desk, island, dt, scratch);
    } else {
        advanceIsland(world, desk, dt, scratch, islands.meets[island]);
    }
}

/// Those that neither bounced off each other in flight nor got through the step with all else.
void listWaiting(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.waiting.clear();
    for (std::uint32_t island = 0; island < fast.clashes.size(); ++island) {
        if (fast.clashes[island] != ClashEnd::none) {
            if (fast.clashes[island] == ClashEnd::dissolved) { continue; }
            ++world.counters.clashes;
            world.counters.sweeps += fast.bodies.of(island).size();
            continue;
        }
        if (fast.isTried[island] == 0 || fast.meets[island] < 1) { fast.waiting.push_back(island); }
    }
}

/// Each on a worker of its own; what they share has its size before.
void advanceAtOnce(WorldState& world, double dt) {
    const std::size_t slots = world.bodies.slotCount();
    world.energyAccounts.resize(slots);
    world.firstGroundContact.resize(slots, kNoIndex);
    const auto workers = static_cast<std::size_t>(world.loops->workerCount());
    while (world.desks.size() < workers) { world.desks.emplace_back(); }
    world.flightScratch.resize(std::max(workers, world.flightScratch.size()));
    const std::vector<std::uint32_t>& waiting = world.fastIslands.waiting;
    world.loops->run(waiting.size(), kIslandGrain, [&](std::size_t begin, std::size_t end, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        world.desks[w].loops = &world.serialTasks;
        for (std::size_t i = begin; i < end; ++i) {
            advanceOne(world, world.desks[w], waiting[i], dt, world.flightScratch[w]);
        }
    });
    for (IslandDesk& desk : world.desks) { clearDesk(world, desk); }
}

void advanceInTurn(WorldState& world, double dt) {
    if (world.desks.empty()) { world.desks.emplace_back(); }
    IslandDesk& desk = world.desks[0];
    desk.loops = world.loops;
    for (const std::uint32_t island : world.fastIslands.waiting) {
        advanceOne(world, desk, island, dt, world.flightScratch[0]);
    }
    clearDesk(world, desk);
}

/// Their order does not matter but to their budgets, and where kinematic bodies are put to where they are in the time
/// that one of them is at.
bool areApart(const WorldState& world) {
    const FastIslands& fast = world.fastIslands;
    return fast.waiting.size() > 1 && fast.ground.slots.empty() && !hasErrorBudget(world.settings);
}

}  // namespace

void findFastIslands(WorldState& world) {
    numberIslands(world);
    if (world.fastIslands.any) {
        listBodies(world);
        listMovingGround(world);
        promoteClashing(world);
        listFastContacts(world);
        listFastJoints(world);
    }
}

void beginFastIslands(WorldState& world, double dt) {
    clashAll(world, dt);
    dissolveClashes(world);
    beginFirstTry(world, dt);
}

void advanceFastIslands(WorldState& world, double dt) {
    judgeFirstTry(world, dt);
    listWaiting(world);
    if (areApart(world)) {
        advanceAtOnce(world, dt);
    } else {
        advanceInTurn(world, dt);
    }
    addFoundContacts(world);
}

}  // namespace swept::inline SWEPT_PRECISION
