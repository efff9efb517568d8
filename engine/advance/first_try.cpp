#include "first_try.h"

#include <algorithm>

#include "../flight/chain_crossing.h"
#include "../solve/lent_energy.h"
#include "../solve/solve_outcome.h"
#include "../state/profile.h"
#include "island_advance.h"
#include "part_sub_steps.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Islands per block of a parallel loop: each is looked at, or has a sweep or two.
constexpr std::size_t kTryGrain = 4;

/// Of what they keep from step to step all is put back.
bool mayBePutBack(const WorldState& world, std::uint32_t joint) {
    switch (world.joints[joint].type()) {
        case JointType::revolute:
        case JointType::prismatic:
        case JointType::wheel:
        case JointType::weld:
        case JointType::distance:
        case JointType::motor:
        case JointType::mouse:
            return true;
        default:
            return false;
    }
}

/// Whether joints of islands without contacts are solved so.
constexpr bool isOfFreeJoints(DirectScope scope) {
    return scope == DirectScope::islands || scope == DirectScope::islandsWithDrives ||
           scope == DirectScope::softJoints || scope == DirectScope::freeJoints;
}

/// Whether the members are solved the same way together with others.
bool mayBeTried(const WorldState& world, std::size_t island, double dt) {
    const FastIslands& fast = world.fastIslands;
    if (fast.clashes[island] != ClashEnd::none) { return false; }
    const Effort effort = world.bodies[fast.bodies.of(island)[0]].effort;
    const std::span<const std::uint32_t> joints = fast.joints.of(island);
    const auto isPutBack = [&world](std::uint32_t joint) { return mayBePutBack(world, joint); };
    const bool isPlain = joints.empty() ? effort.doublings == 0
                                        : (effort.direct == DirectScope::none || isOfFreeJoints(effort.direct)) &&
                                              (effort.doublings == 0 || effort.isCrowd()) &&
                                              std::all_of(joints.begin(), joints.end(), isPutBack);
    return isPlain && !effort.isSettled && isOnePart(world, fast.bodies.of(island), joints, dt);
}

/// By a body of a contact.
std::uint32_t islandOf(const FastIslands& fast, std::uint32_t bodyA, std::uint32_t bodyB) {
    return fast.numbers[bodyA] != kNoIndex ? fast.numbers[bodyA] : fast.numbers[bodyB];
}

/// Of many contacts with restitution each bounces in its turn, of few all at once: in profile `accurate` what bounces
/// off a few others keeps to that.
void leaveOutBouncing(const WorldState& world, std::vector<std::uint8_t>& isTried) {
    if (world.bouncyShapes == 0 || world.settings.profile == Profile::fast) { return; }
    for (const TouchingPair& pair : world.touching) {
        const std::uint32_t island = islandOf(world.fastIslands, pair.bodyA, pair.bodyB);
        if (pair.bounces && island != kNoIndex) { isTried[island] = 0; }
    }
}

void rememberContacts(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.triedContacts.clear();
    for (const TouchingPair& pair : world.touching) {
        const std::uint32_t island = islandOf(fast, pair.bodyA, pair.bodyB);
        if (island == kNoIndex || fast.isTried[island] == 0) { continue; }
        const Contact& contact = world.contacts[pair.contact];
        fast.triedContacts.push_back({.island = island, .before = outcomeOf(contact, pair.contact)});
    }
}

bool isHinge(const WorldState& world, std::uint32_t joint) { return world.jointTies[joint].isHinge; }

/// Where each island keeps what it remembers.
void placeTried(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    TriedPlace next;
    fast.triedPlaces.resize(fast.isTried.size());
    for (std::size_t i = 0; i < fast.isTried.size(); ++i) {
        fast.triedPlaces[i] = next;
        if (fast.isTried[i] == 0) { continue; }
        next.body += fast.bodies.of(i).size();
        for (const std::uint32_t joint : fast.joints.of(i)) { ++(isHinge(world, joint) ? next.hinge : next.joint); }
    }
    fast.triedBodies.resize(next.body);
    fast.triedHinges.resize(next.hinge);
    fast.triedJoints.resize(next.joint);
    fast.triedLoans.resize(fast.isTried.size());
}

/// The members of an island before they are solved. Their contacts are not in its hands alone.
void remember(WorldState& world, std::size_t island) {
    FastIslands& fast = world.fastIslands;
    TriedPlace place = fast.triedPlaces[island];
    for (const std::uint32_t slot : fast.bodies.of(island)) {
        fast.triedBodies[place.body++] = outcomeOf(world, slot);
        world.bodies[slot].role = BodyRole::solved;
    }
    if (const LentEnergy* const lent = lentOf(world, fast.joints.of(island))) { fast.triedLoans[island] = *lent; }
    for (const std::uint32_t joint : fast.joints.of(island)) {
        if (isHinge(world, joint)) {
            fast.triedHinges[place.hinge++] = {world.joints[joint].hinge, world.joints[joint].restLoad};
        } else {
            fast.triedJoints[place.joint++] = world.joints[joint];
        }
    }
}

/// Whether they met something, and if so, they are as they were.
void judge(WorldState& world, std::size_t island, double dt, FlightScratch& scratch) {
    FastIslands& fast = world.fastIslands;
    const std::span<const std::uint32_t> members = fast.bodies.of(island);
    const StepPart part{.length = dt, .dt = dt};
    scratch.chains.meetsBacks = false;
    fast.meets[island] = firstImpactOf(world, members, part, scratch);
    const bool meets = fast.meets[island] < 1;
    scratch.counters.impacts += meets ? 1 : 0;
    if (!meets) {
        holdSunk(world, members, part, scratch);
        noteCrossingsOf(world, members, part, scratch);
        endCrossings(scratch);
    }
    TriedPlace place = fast.triedPlaces[island];
    for (const std::uint32_t slot : members) {
        world.bodies[slot].role = BodyRole::together;
        if (meets) { restore(world, slot, fast.triedBodies[place.body++]); }
    }
    if (!meets) { return; }
    if (LentEnergy* const lent = lentOf(world, fast.joints.of(island))) { *lent = fast.triedLoans[island]; }
    for (const std::uint32_t joint : fast.joints.of(island)) {
        if (!isHinge(world, joint)) {
            world.joints[joint] = fast.triedJoints[place.joint++];
            continue;
        }
        const TriedHinge& before = fast.triedHinges[place.hinge++];
        world.joints[joint].hinge = before.hinge;
        world.joints[joint].restLoad = before.restLoad;
    }
}

void takeBackContacts(WorldState& world) {
    const FastIslands& fast = world.fastIslands;
    for (const TriedContact& tried : fast.triedContacts) {
        if (fast.meets[tried.island] < 1) { restore(world.contacts[tried.before.contact], tried.before); }
    }
    const auto first = world.contactEvents.begin() + static_cast<std::ptrdiff_t>(fast.eventsBefore);
    const auto isOfIsland = [&fast](const ContactEvent& event) {
        const std::uint32_t island = islandOf(fast, event.bodyA.index, event.bodyB.index);
        return island != kNoIndex && fast.isTried[island] != 0 && fast.meets[island] < 1;
    };
    world.contactEvents.erase(std::remove_if(first, world.contactEvents.end(), isOfIsland), world.contactEvents.end());
}

}  // namespace

void beginFirstTry(WorldState& world, double dt) {
    FastIslands& fast = world.fastIslands;
    const std::size_t count = fast.clashes.size();
    fast.isTried.assign(count, 0);
    fast.meets.assign(count, 1);
    fast.eventsBefore = world.contactEvents.size();
    if (world.watched || hasErrorBudget(world.settings)) { return; }
    world.loops->run(count, kTryGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { fast.isTried[i] = mayBeTried(world, i, dt) ? 1 : 0; }
    });
    leaveOutBouncing(world, fast.isTried);
    placeTried(world);
    world.loops->run(count, kTryGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            if (fast.isTried[i] != 0) { remember(world, i); }
        }
    });
    rememberContacts(world);
}

void judgeFirstTry(WorldState& world, double dt) {
    FastIslands& fast = world.fastIslands;
    world.loops->run(fast.isTried.size(), kTryGrain, [&](std::size_t begin, std::size_t end, int worker) {
        FlightScratch& scratch = world.flightScratch[static_cast<std::size_t>(worker)];
        for (std::size_t i = begin; i < end; ++i) {
            if (fast.isTried[i] != 0) { judge(world, i, dt, scratch); }
        }
    });
    const auto meets = [](double fraction) { return fraction < 1; };
    if (std::any_of(fast.meets.begin(), fast.meets.end(), meets)) { takeBackContacts(world); }
}

}  // namespace swept::inline SWEPT_PRECISION
