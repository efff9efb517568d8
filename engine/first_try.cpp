#include "first_try.h"

#include <algorithm>

#include "island_advance.h"
#include "profile.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Whether the members are solved the same way together with others. Of joints, hinges are: what they keep from step to
/// step is little, and is put back.
bool mayBeTried(const WorldState& world, std::size_t island, double dt) {
    const FastIslands& fast = world.fastIslands;
    if (fast.isDone[island] != 0) { return false; }
    const Effort effort = world.bodies[fast.bodies.of(island)[0]].effort;
    const std::span<const std::uint32_t> joints = fast.joints.of(island);
    const auto isHinge = [&world](std::uint32_t joint) { return world.jointTies[joint].isHinge; };
    const bool isPlain = joints.empty()
                             ? effort.doublings == 0
                             : effort.direct == DirectScope::none && (effort.doublings == 0 || effort.isCrowd) &&
                                   std::all_of(joints.begin(), joints.end(), isHinge);
    return isPlain && !effort.isSettled && isOnePart(world, fast.bodies.of(island), !joints.empty(), dt);
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
        fast.triedContacts.push_back({.contact = pair.contact,
                                      .island = island,
                                      .normalImpulse = contact.normalImpulse,
                                      .tangentImpulse = contact.tangentImpulse,
                                      .totalImpulse = contact.totalImpulse,
                                      .approachSpeed = contact.approachSpeed,
                                      .pressed = contact.pressed,
                                      .pressedOn = contact.pressedOn});
    }
}

void rememberHinges(WorldState& world, std::size_t island) {
    FastIslands& fast = world.fastIslands;
    for (const std::uint32_t joint : fast.joints.of(island)) {
        fast.triedHinges.push_back({.joint = joint, .memory = world.joints[joint].hinge});
    }
}

void takeBackContacts(WorldState& world) {
    const FastIslands& fast = world.fastIslands;
    for (const TriedContact& before : fast.triedContacts) {
        if (!(fast.meets[before.island] < 1)) { continue; }
        Contact& contact = world.contacts[before.contact];
        contact.normalImpulse = before.normalImpulse;
        contact.tangentImpulse = before.tangentImpulse;
        contact.totalImpulse = before.totalImpulse;
        contact.approachSpeed = before.approachSpeed;
        contact.pressed = before.pressed;
        contact.pressedOn = before.pressedOn;
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
    const std::size_t count = fast.isDone.size();
    fast.isTried.assign(count, 0);
    fast.meets.assign(count, 1);
    fast.triedMotions.clear();
    fast.triedHinges.clear();
    fast.eventsBefore = world.contactEvents.size();
    if (world.watched || hasErrorBudget(world.settings)) { return; }
    for (std::size_t i = 0; i < count; ++i) { fast.isTried[i] = mayBeTried(world, i, dt) ? 1 : 0; }
    leaveOutBouncing(world, fast.isTried);
    for (std::size_t i = 0; i < count; ++i) {
        if (fast.isTried[i] == 0) { continue; }
        for (const std::uint32_t slot : fast.bodies.of(i)) {
            fast.triedMotions.push_back(world.motions[slot]);
            world.bodies[slot].role = BodyRole::solved;
        }
        rememberHinges(world, i);
    }
    rememberContacts(world);
}

void judgeFirstTry(WorldState& world, double dt, FlightScratch& scratch) {
    FastIslands& fast = world.fastIslands;
    bool anyMeets = false;
    std::size_t motion = 0;
    std::size_t hinge = 0;
    for (std::size_t i = 0; i < fast.isTried.size(); ++i) {
        if (fast.isTried[i] == 0) { continue; }
        const std::span<const std::uint32_t> members = fast.bodies.of(i);
        fast.meets[i] = firstImpactOf(world, members, {.length = dt, .dt = dt}, scratch);
        const bool meets = fast.meets[i] < 1;
        scratch.impacts += meets ? 1 : 0;
        anyMeets = anyMeets || meets;
        if (!meets) { holdSunk(world, members, {.length = dt, .dt = dt}, scratch); }
        for (const std::uint32_t slot : members) {
            Body& body = world.bodies[slot];
            body.role = BodyRole::together;
            if (meets) {
                world.motions[slot] = fast.triedMotions[motion];
                body.flung = false;
            }
            ++motion;
        }
        for (std::size_t joints = fast.joints.of(i).size(); joints > 0; --joints) {
            const TriedHinge& before = fast.triedHinges[hinge++];
            if (meets) { world.joints[before.joint].hinge = before.memory; }
        }
    }
    if (anyMeets) { takeBackContacts(world); }
}

}  // namespace swept::inline SWEPT_PRECISION
