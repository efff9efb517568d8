#include "hemmed_pairs.h"

#include <vector>

#include "../state/tolerances.h"
#include "near_update.h"
#include "noticing.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Places of the probes that pass each other, now that those before them whose boxes are apart are gone.
void findUnasked(WorldState& world) {
    const ContactLists& lists = world.lists;
    world.hemmed.unasked.clear();
    std::uint32_t gone = 0;
    for (const std::uint32_t place : lists.passing) {
        while (gone < lists.apart.size() && lists.apart[gone] < place) { ++gone; }
        world.hemmed.unasked.push_back(place - gone);
    }
}

void findGroups(WorldState& world) {
    HemmedPairs& hemmed = world.hemmed;
    hemmed.groups.reset(world.bodies.slotCount(), world.awake);
    hemmed.groups.uniteAs(world.islands);
    for (const TouchingPair& pair : hemmed.passing) { hemmed.groups.unite(pair.bodyA, pair.bodyB); }
    for (const std::uint32_t place : hemmed.unasked) {
        hemmed.groups.unite(world.probes[place].bodyA, world.probes[place].bodyB);
    }
    hemmed.isStruck.assign(world.bodies.slotCount(), 0);
    for (const std::uint32_t slot : world.awake) {
        if ((world.traits[slot] & kHasContact) != 0) { hemmed.isStruck[hemmed.groups.find(slot)] = 1; }
    }
}

bool isInStruckGroup(WorldState& world, std::uint32_t body) {
    return world.hemmed.isStruck[world.hemmed.groups.find(body)] != 0;
}

/// Of what was collided, leaves what the predicate is true of; the rest has no points in this step after all.
/// @return whether there was any other
template <class Predicate>
bool keepCollided(WorldState& world, const Predicate& isKept) {
    return std::erase_if(world.hemmed.unasked, [&world, &isKept](std::uint32_t place) {
               ContactProbe& probe = world.probes[place];
               if (isKept(probe)) { return false; }
               world.contacts[probe.contact].manifold.count = 0;
               probe.points = 0;
               return true;
           }) > 0;
}

/// Leaves of what is told to pass each other from bounds alone what is near enough to be hemmed in, and is.
void askHemmed(WorldState& world) {
    std::vector<std::uint32_t>& unasked = world.hemmed.unasked;
    const auto isStruck = [&world](const ContactProbe& probe) { return isInStruckGroup(world, probe.bodyA); };
    const auto isSpared = [&world, &isStruck](std::uint32_t place) { return !isStruck(world.probes[place]); };
    std::erase_if(unasked, isSpared);
    if (unasked.empty()) { return; }
    collideHemmed(world, unasked);
    const auto isNear = [&world](const ContactProbe& probe) {
        const Contact& contact = world.contacts[probe.contact];
        return contact.manifold.count > 0 && deepestSeparation(contact.manifold) <= kHemRatio * contact.extent;
    };
    if (!keepCollided(world, isNear)) { return; }
    findGroups(world);
    keepCollided(world, isStruck);
}

}  // namespace

void holdHemmedPairs(WorldState& world) {
    HemmedPairs& hemmed = world.hemmed;
    if (hemmed.passing.empty() && world.lists.passing.empty()) { return; }
    findUnasked(world);
    findGroups(world);
    askHemmed(world);
    const std::size_t before = world.touching.size();
    for (const TouchingPair& pair : hemmed.passing) {
        if (isInStruckGroup(world, pair.bodyA)) {
            world.touching.push_back(pair);
        } else {
            world.contacts[pair.contact].manifold.count = 0;
            --world.counters.touching;
        }
    }
    listHemmed(world, hemmed.unasked);
    for (std::size_t i = before; i < world.touching.size(); ++i) {
        const TouchingPair& pair = world.touching[i];
        world.islands.unite(pair.bodyA, pair.bodyB);
        for (const std::uint32_t slot : {pair.bodyA, pair.bodyB}) {
            world.traits[slot] = static_cast<BodyTraits>(world.traits[slot] | kHasContact | kTouchesDynamic);
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
