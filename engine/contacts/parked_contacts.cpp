#include "parked_contacts.h"

#include <algorithm>

#include "../state/profile.h"
#include "../state/world_state.h"
#include "impulse_growth.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts are parked as soon as so many times as many bodies as came to rest are not fewer than are awake.
constexpr std::size_t kAwakePerRested = 8;

void noteWhoIsUp(WorldState& world, std::uint8_t isUp) {
    world.parked.isUp.resize(world.bodies.slotCount());
    for (const std::uint32_t slot : world.awake) { world.parked.isUp[slot] = isUp; }
}

/// As much as the others have: what has room for all of it once needs no more.
template <class Pair>
void reserveBoth(std::vector<Pair>& pairs, ParkedPairs<Pair>& parked) {
    const std::size_t count = pairs.size() + parked.size();
    if (count > pairs.capacity()) { pairs.reserve(std::max(count, 2 * pairs.capacity())); }
    parked.reserve(pairs.capacity());
}

bool isSolid(const WorldState& world, const ContactProbe& probe) { return world.contacts[probe.contact].isSolid(); }

/// Places of the parked pairs of what woke and is awake still, ascending.
template <class Pair>
std::span<const std::uint32_t> placesOfWoken(WorldState& world, const ParkedPairs<Pair>& pairs) {
    std::vector<std::uint32_t>& places = world.parked.places;
    places.clear();
    for (const std::uint32_t slot : world.parked.woken) {
        if (!world.bodies.isAlive(slot) || !world.bodies[slot].awake) { continue; }
        for (const std::uint32_t shape : world.bodies[slot].shapes) {
            pairs.visitOf(world.shapes[shape].proxy, [&places](std::uint32_t place) { places.push_back(place); });
        }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    return places;
}

ParkedImpulses impulsesOf(const WorldState& world, const ContactProbe& probe) {
    const Contact& contact = world.contacts[probe.contact];
    return {.dt = world.lastDt,
            .subSteps = subStepsOf(world.settings),
            .wasStill = wasStill(contact, world.bodies[probe.bodyA], world.bodies[probe.bodyB])};
}

void park(WorldState& world, const ContactProbe& probe) {
    ParkedContacts& parked = world.parked;
    const std::uint32_t place = parked.probes.add(probe);
    if (place >= parked.impulses.size()) { parked.impulses.resize(place + 1); }
    parked.impulses[place] = impulsesOf(world, probe);
}

/// By the same arithmetic as those of what is not parked (step_change.cpp).
void renewImpulses(WorldState& world, std::uint32_t place) {
    const ParkedImpulses& before = world.parked.impulses[place];
    const int subSteps = subStepsOf(world.settings);
    if ((before.dt == world.lastDt && before.subSteps == subSteps) || !(before.dt > 0)) { return; }
    const double ratio = static_cast<double>(subSteps) / before.subSteps;
    Contact& contact = world.contacts[world.parked.probes[place].contact];
    scaleToSubStep(contact, static_cast<Real>(world.lastDt / before.dt * (1 / ratio)), before.wasStill);
}

/// What is parked next takes the places from the first one on.
template <class Pair>
void erase(ParkedPairs<Pair>& pairs, std::span<const std::uint32_t> places) {
    for (std::size_t i = places.size(); i > 0; --i) { pairs.erase(places[i - 1]); }
}

}  // namespace

void parkContacts(WorldState& world) {
    ParkedContacts& parked = world.parked;
    if (parked.rested == 0 || parked.rested * kAwakePerRested < world.awake.size()) { return; }
    parked.rested = 0;
    noteWhoIsUp(world, 1);
    const auto rests = [&parked](const ContactPair& pair) {
        return (parked.isUp[pair.bodyA] | parked.isUp[pair.bodyB]) == 0;
    };
    reserveBoth(world.probes, parked.probes);
    parked.impulses.reserve(parked.probes.capacity());
    reserveBoth(world.candidates, parked.candidates);
    std::erase_if(world.probes, [&](ContactProbe& probe) {
        if (!rests(probe)) { return false; }
        if (probe.isUnseen) {
            ++parked.rested;  // comes next, once it was looked at
            return false;
        }
        parked.touching += isSolid(world, probe) ? 1 : 0;
        probe.state = ContactState::asleep;
        park(world, probe);
        return true;
    });
    std::erase_if(world.candidates, [&](const ContactPair& pair) {
        if (!rests(pair)) { return false; }
        parked.candidates.add(pair);
        return true;
    });
    noteWhoIsUp(world, 0);
}

std::size_t unparkContacts(WorldState& world) {
    ParkedContacts& parked = world.parked;
    if (parked.woken.empty()) { return 0; }
    const std::span<const std::uint32_t> places = placesOfWoken(world, parked.probes);
    for (const std::uint32_t place : places) {
        renewImpulses(world, place);
        world.probes.push_back(parked.probes[place]);
        parked.touching -= isSolid(world, parked.probes[place]) ? 1 : 0;
    }
    erase(parked.probes, places);
    const std::size_t count = places.size();
    const std::span<const std::uint32_t> candidates = placesOfWoken(world, parked.candidates);
    for (const std::uint32_t place : candidates) { world.candidates.push_back(parked.candidates[place]); }
    erase(parked.candidates, candidates);
    parked.woken.clear();
    return count;
}

}  // namespace swept::inline SWEPT_PRECISION
