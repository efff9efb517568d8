#include "parked_contacts.h"

#include <algorithm>
#include <utility>

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts are parked as soon as so many times as many bodies as came to rest are not more than are awake.
constexpr std::size_t kAwakePerRested = 8;

void noteWhoIsUp(WorldState& world) {
    std::vector<std::uint8_t>& isUp = world.parked.isUp;
    isUp.assign(world.bodies.slotCount(), 0);
    for (const std::uint32_t slot : world.awake) { isUp[slot] = 1; }
}

/// As much as the others have: what has room for all of it once needs no more.
void reserveAll(WorldState& world) {
    ParkedContacts& parked = world.parked;
    parked.probes.reserve(world.probes.capacity());
    const std::size_t pairs = std::max(world.candidates.capacity(), parked.candidates.capacity());
    world.candidates.reserve(pairs);
    parked.candidates.reserve(pairs);
}

bool isSolid(const WorldState& world, const ContactProbe& probe) { return world.contacts[probe.contact].isSolid(); }

}  // namespace

void parkContacts(WorldState& world) {
    ParkedContacts& parked = world.parked;
    if (parked.rested == 0 || parked.rested * kAwakePerRested < world.awake.size()) { return; }
    parked.rested = 0;
    noteWhoIsUp(world);
    const auto rests = [&parked](const ContactPair& pair) {
        return (parked.isUp[pair.bodyA] | parked.isUp[pair.bodyB]) == 0;
    };
    reserveAll(world);
    parked.probes.clear();
    std::size_t kept = 0;
    for (std::size_t i = 0; i < world.activeContacts; ++i) {
        if (!world.probes[i].isUnseen && rests(world.probes[i])) {
            parked.touching += isSolid(world, world.probes[i]) ? 1 : 0;
            parked.probes.push_back(world.probes[i]);
            parked.probes.back().state = ContactState::asleep;
            continue;
        }
        if (kept != i) { world.probes[kept] = world.probes[i]; }
        ++kept;
    }
    world.activeContacts = kept;
    std::copy(parked.probes.begin(), parked.probes.end(), world.probes.begin() + static_cast<std::ptrdiff_t>(kept));
    std::erase_if(world.candidates, [&](const ContactPair& pair) {
        if (!rests(pair)) { return false; }
        parked.candidates.push_back(pair);
        return true;
    });
}

std::size_t unparkContacts(WorldState& world) {
    ParkedContacts& parked = world.parked;
    if (!parked.woke) { return 0; }
    parked.woke = false;
    if (world.activeContacts == world.probes.size() && parked.candidates.empty()) { return 0; }
    noteWhoIsUp(world);
    const auto isUp = [&parked](const ContactPair& pair) {
        return (parked.isUp[pair.bodyA] | parked.isUp[pair.bodyB]) != 0;
    };
    const std::size_t before = world.activeContacts;
    for (std::size_t i = before; i < world.probes.size(); ++i) {
        if (!isUp(world.probes[i])) { continue; }
        parked.touching -= isSolid(world, world.probes[i]) ? 1 : 0;
        const std::size_t place = world.activeContacts++;
        if (place != i) { std::swap(world.probes[place], world.probes[i]); }
    }
    std::erase_if(parked.candidates, [&](const ContactPair& pair) {
        if (!isUp(pair)) { return false; }
        world.candidates.push_back(pair);
        return true;
    });
    return world.activeContacts - before;
}

}  // namespace swept::inline SWEPT_PRECISION
