#include <algorithm>

#include "island_advance.h"
#include "modes.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isFastTied(const WorldState& world, const Body& body) {
    return body.role == BodyRole::solved && body.fast && modeOf(world, body) == ContinuousMode::subStep;
}

/// Marks the islands, and gives all their bodies the role `together`.
void listBodies(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.bodies.clear();
    for (const std::uint32_t slot : world.awake) {
        if (!isFastTied(world, world.bodies[slot])) { continue; }
        if (!fast.any) { fast.isFast.assign(world.bodies.slotCount(), 0); }
        fast.any = true;
        fast.isFast[world.islands.find(slot)] = 1;
    }
    if (!fast.any) { return; }
    fast.kinematics.clear();
    for (std::uint32_t i = 0; i < world.awake.size(); ++i) {
        const std::uint32_t slot = world.awake[i];
        const Body& body = world.bodies[slot];
        if (body.def.type == BodyType::kinematic) { fast.kinematics.push_back(slot); }
        const std::uint32_t root = world.islands.find(slot);
        if (body.role != BodyRole::solved || fast.isFast[root] == 0) { continue; }
        fast.bodies.push_back({root, i, slot});
    }
    std::sort(fast.bodies.begin(), fast.bodies.end());
    for (const IslandItem& item : fast.bodies) { world.bodies[item.item].role = BodyRole::together; }
}

/// The member of two bodies, if there is one.
std::uint32_t memberOf(const WorldState& world, std::uint32_t a, std::uint32_t b) {
    if (world.bodies[a].role == BodyRole::together) { return a; }
    return world.bodies[b].role == BodyRole::together ? b : kNoIndex;
}

void listContactsAndJoints(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.contacts.clear();
    fast.joints.clear();
    for (std::uint32_t i = 0; i < world.contacts.size(); ++i) {
        const Contact& contact = world.contacts[i];
        const std::uint32_t member = memberOf(world, contact.bodyA, contact.bodyB);
        if (contact.sensor || member == kNoIndex) { continue; }
        fast.contacts.push_back({world.islands.find(member), i, i});
    }
    for (const std::uint32_t i : world.activeJoints) {
        for (const std::uint32_t slot : world.joints[i].allBodies()) {
            if (world.bodies[slot].role != BodyRole::together) { continue; }
            fast.joints.push_back({world.islands.find(slot), i, i});
            break;
        }
    }
    std::sort(fast.contacts.begin(), fast.contacts.end());
    std::sort(fast.joints.begin(), fast.joints.end());
}

/// Items of one island, from `next` on, which moves behind them.
template <class Take>
void takeIsland(const std::vector<IslandItem>& items, std::size_t& next, std::uint32_t root, const Take& take) {
    for (; next < items.size() && items[next].root == root; ++next) { take(items[next].item); }
}

/// Contacts of dynamic bodies of two islands (a member that touches nothing yet) stay with the first; those are left out.
bool isInside(const WorldState& world, const Contact& contact) {
    const Body& a = world.bodies[contact.bodyA];
    const Body& b = world.bodies[contact.bodyB];
    return !a.isDynamic() || !b.isDynamic() || contact.isSolid();
}

}  // namespace

void findFastIslands(WorldState& world) {
    listBodies(world);
    if (world.fastIslands.any) { listContactsAndJoints(world); }
}

void advanceFastIslands(WorldState& world, double dt) {
    FastIslands& fast = world.fastIslands;
    if (world.flightScratch.empty()) { world.flightScratch.resize(1); }
    std::size_t body = 0;
    std::size_t contact = 0;
    std::size_t joint = 0;
    while (body < fast.bodies.size()) {
        const std::uint32_t root = fast.bodies[body].root;
        fast.members.clear();
        fast.jointSlots.clear();
        fast.held.clear();
        fast.sources.clear();
        takeIsland(fast.bodies, body, root, [&](std::uint32_t slot) { fast.members.push_back(slot); });
        takeIsland(fast.joints, joint, root, [&](std::uint32_t slot) { fast.jointSlots.push_back(slot); });
        takeIsland(fast.contacts, contact, root, [&](std::uint32_t index) {
            if (!isInside(world, world.contacts[index])) { return; }
            fast.held.push_back(world.contacts[index]);
            fast.sources.push_back(index);
        });
        advanceIsland(world, dt, world.flightScratch[0]);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
