#include <algorithm>

#include "clash.h"
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
        if (!isFastTied(world, world.bodies[slot])) {
            continue;
        }
        if (!fast.any) {
            fast.isFast.assign(world.bodies.slotCount(), 0);
        }
        fast.any = true;
        fast.isFast[world.islands.find(slot)] = 1;
    }
    if (!fast.any) {
        return;
    }
    fast.kinematics.clear();
    for (std::uint32_t i = 0; i < world.awake.size(); ++i) {
        const std::uint32_t slot = world.awake[i];
        const Body& body = world.bodies[slot];
        if (body.def.type == BodyType::kinematic) {
            fast.kinematics.push_back(slot);
        }
        if (body.role != BodyRole::solved) {
            continue;
        }
        const std::uint32_t root = world.islands.find(slot);
        if (fast.isFast[root] == 0) {
            continue;
        }
        fast.bodies.push_back({root, i, slot});
    }
    std::sort(fast.bodies.begin(), fast.bodies.end());
    for (const IslandItem& item : fast.bodies) {
        world.bodies[item.item].role = BodyRole::together;
    }
}

/// The member of two bodies, if there is one.
std::uint32_t memberOf(const WorldState& world, std::uint32_t a, std::uint32_t b) {
    if (world.bodies[a].role == BodyRole::together) {
        return a;
    }
    return world.bodies[b].role == BodyRole::together ? b : kNoIndex;
}

void listContactsAndJoints(WorldState& world) {
    FastIslands& fast = world.fastIslands;
    fast.contacts.clear();
    fast.joints.clear();
    for (std::uint32_t i = 0; i < world.contacts.size(); ++i) {
        const Contact& contact = world.contacts[i];
        const std::uint32_t member = memberOf(world, contact.bodyA, contact.bodyB);
        if (contact.sensor || member == kNoIndex) {
            continue;
        }
        fast.contacts.push_back({world.islands.find(member), i, i});
    }
    for (const std::uint32_t i : world.activeJoints) {
        for (const std::uint32_t slot : world.joints[i].allBodies()) {
            if (world.bodies[slot].role != BodyRole::together) {
                continue;
            }
            fast.joints.push_back({world.islands.find(slot), i, i});
            break;
        }
    }
    std::sort(fast.contacts.begin(), fast.contacts.end());
    std::sort(fast.joints.begin(), fast.joints.end());
}

/// Islands per task: each has several sweeps.
constexpr std::size_t kClashGrain = 2;

/// Items of one island, from `next` on, which moves behind them. @return how many
std::uint32_t takeIsland(const std::vector<IslandItem>& items, std::uint32_t& next, std::uint32_t root) {
    const std::uint32_t first = next;
    while (next < items.size() && items[next].root == root) {
        ++next;
    }
    return next - first;
}

void listRanges(FastIslands& fast) {
    fast.bodySlots.clear();
    for (const IslandItem& item : fast.bodies) {
        fast.bodySlots.push_back(item.item);
    }
    fast.contactIndices.clear();
    for (const IslandItem& item : fast.contacts) {
        fast.contactIndices.push_back(item.item);
    }
    fast.ranges.clear();
    IslandRange next;
    while (next.bodies < fast.bodies.size()) {
        const std::uint32_t root = fast.bodies[next.bodies].root;
        IslandRange range = next;
        range.bodyCount = takeIsland(fast.bodies, next.bodies, root);
        range.contactCount = takeIsland(fast.contacts, next.contacts, root);
        range.jointCount = takeIsland(fast.joints, next.joints, root);
        fast.ranges.push_back(range);
    }
}

/// What bounces off each other in flight.
void clashAll(WorldState& world, double dt) {
    FastIslands& fast = world.fastIslands;
    const auto workers = static_cast<std::size_t>(world.loops->workerCount());
    world.flightScratch.resize(std::max(workers, world.flightScratch.size()));
    world.clashScratch.resize(std::max(workers, world.clashScratch.size()));
    world.loops->run(fast.ranges.size(), kClashGrain, [&](std::size_t begin, std::size_t end, int worker) {
        const auto w = static_cast<std::size_t>(worker);
        for (std::size_t i = begin; i < end; ++i) {
            IslandRange& range = fast.ranges[i];
            const std::span<const std::uint32_t> bodies =
                std::span(fast.bodySlots).subspan(range.bodies, range.bodyCount);
            const std::span<const std::uint32_t> contacts =
                std::span(fast.contactIndices).subspan(range.contacts, range.contactCount);
            range.isDone = range.jointCount == 0 &&
                           clash(world, bodies, contacts, dt, world.flightScratch[w], world.clashScratch[w]);
        }
    });
}

/// Contacts of dynamic bodies of two islands (a member that touches nothing yet) stay with the first; those are left
/// out.
bool isInside(const WorldState& world, const Contact& contact) {
    const Body& a = world.bodies[contact.bodyA];
    const Body& b = world.bodies[contact.bodyB];
    return !a.isDynamic() || !b.isDynamic() || contact.isSolid();
}

}  // namespace

void findFastIslands(WorldState& world) {
    listBodies(world);
    if (world.fastIslands.any) {
        listContactsAndJoints(world);
    }
}

void advanceFastIslands(WorldState& world, double dt) {
    FastIslands& fast = world.fastIslands;
    listRanges(fast);
    clashAll(world, dt);
    for (const IslandRange& range : fast.ranges) {
        if (range.isDone) {
            ++world.counters.clashes;
            world.counters.sweeps += range.bodyCount;
            continue;
        }
        const auto bodies = fast.bodySlots.begin() + range.bodies;
        fast.members.assign(bodies, bodies + range.bodyCount);
        fast.jointSlots.clear();
        for (std::uint32_t i = 0; i < range.jointCount; ++i) {
            fast.jointSlots.push_back(fast.joints[range.joints + i].item);
        }
        fast.held.clear();
        fast.sources.clear();
        for (std::uint32_t i = 0; i < range.contactCount; ++i) {
            const std::uint32_t index = fast.contactIndices[range.contacts + i];
            if (!isInside(world, world.contacts[index])) {
                continue;
            }
            fast.held.push_back(world.contacts[index]);
            fast.sources.push_back(index);
        }
        advanceIsland(world, dt, world.flightScratch[0]);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
