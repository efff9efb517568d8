#include "hemmed_pairs.h"

#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Places of the probes that pass each other, now that those before them whose boxes are apart are gone.
template <class Visit>
void visitPassingProbes(const ContactLists& lists, const Visit& visit) {
    std::uint32_t gone = 0;
    for (const std::uint32_t place : lists.passing) {
        while (gone < lists.apart.size() && lists.apart[gone] < place) { ++gone; }
        visit(place - gone);
    }
}

void findGroups(WorldState& world) {
    HemmedPairs& hemmed = world.hemmed;
    hemmed.groups = world.islands;
    for (const TouchingPair& pair : hemmed.passing) { hemmed.groups.unite(pair.bodyA, pair.bodyB); }
    visitPassingProbes(world.lists, [&world, &hemmed](std::uint32_t place) {
        hemmed.groups.unite(world.probes[place].bodyA, world.probes[place].bodyB);
    });
    hemmed.isStruck.assign(world.bodies.slotCount(), 0);
    for (const std::uint32_t slot : world.awake) {
        if ((world.traits[slot] & kHasContact) != 0) { hemmed.isStruck[hemmed.groups.find(slot)] = 1; }
    }
}

}  // namespace

void holdHemmedPairs(WorldState& world) {
    HemmedPairs& hemmed = world.hemmed;
    if (hemmed.passing.empty() && world.lists.passing.empty()) { return; }
    findGroups(world);
    const std::size_t before = world.touching.size();
    for (const TouchingPair& pair : hemmed.passing) {
        if (hemmed.isStruck[hemmed.groups.find(pair.bodyA)] != 0) {
            world.touching.push_back(pair);
        } else {
            world.contacts[pair.contact].manifold.count = 0;
            --world.counters.touching;
        }
    }
    hemmed.stopped.clear();
    visitPassingProbes(world.lists, [&world, &hemmed](std::uint32_t place) {
        const bool isStruck = hemmed.isStruck[hemmed.groups.find(world.probes[place].bodyA)] != 0;
        if (isStruck) { hemmed.stopped.push_back(place); }
    });
    collideHemmed(world, hemmed.stopped);
    for (std::size_t i = before; i < world.touching.size(); ++i) {
        const TouchingPair& pair = world.touching[i];
        world.islands.unite(pair.bodyA, pair.bodyB);
        for (const std::uint32_t slot : {pair.bodyA, pair.bodyB}) {
            world.traits[slot] = static_cast<BodyTraits>(world.traits[slot] | kHasContact | kTouchesDynamic);
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
