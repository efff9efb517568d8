#include "pairs_of_shapes.h"

#include <algorithm>
#include <array>

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// To list the pairs of all shapes takes as long as two looks at all pairs.
constexpr int kScansBeforeLists = 2;

/// Calls `visit` with each pair that is no gap and its place, in order.
template <class Visit>
void forEachPair(WorldState& world, const Visit& visit) {
    std::uint32_t place = 0;
    const auto go = [&](auto& pairs) {
        for (ContactPair& pair : pairs) {
            if (!isGap(pair)) { visit(pair, place); }
            ++place;
        }
    };
    go(world.probes);
    go(world.candidates);
    go(world.parked.candidates);
}

ContactPair& pairAt(WorldState& world, std::size_t place) {
    if (place < world.probes.size()) { return world.probes[place]; }
    place -= world.probes.size();
    if (place < world.candidates.size()) { return world.candidates[place]; }
    return world.parked.candidates[place - world.candidates.size()];
}

std::array<std::size_t, 2> proxiesOf(const ContactPair& pair) {
    return {static_cast<std::size_t>(pair.proxyA), static_cast<std::size_t>(pair.proxyB)};
}

/// Sorts places by proxy, by counting.
void listPairs(WorldState& world) {
    PairsOfShapes& lists = world.pairsOfShapes;
    lists.isListed = true;
    lists.begins.assign(world.proxyShapes.size() + 1, 0);
    std::uint32_t entries = 0;
    forEachPair(world, [&](const ContactPair& pair, std::uint32_t) {
        for (const std::size_t proxy : proxiesOf(pair)) { ++lists.begins[proxy]; }
        entries += 2;
    });
    lists.places.resize(entries);
    // Begins are ends at first, and move down as the places come, from the last one on.
    std::uint32_t end = 0;
    for (std::uint32_t& begin : lists.begins) { begin = end += begin; }
    forEachPair(world, [&](const ContactPair& pair, std::uint32_t place) {
        for (const std::size_t proxy : proxiesOf(pair)) { lists.places[--lists.begins[proxy]] = place; }
    });
}

}  // namespace

std::span<const std::uint32_t> pairsOf(WorldState& world, std::span<const std::uint32_t> shapes,
                                       FunctionRef<bool(const ContactPair&)> isMeant) {
    PairsOfShapes& lists = world.pairsOfShapes;
    lists.found.clear();
    if (!lists.isListed && lists.scans < kScansBeforeLists) {
        ++lists.scans;
        forEachPair(world, [&](const ContactPair& pair, std::uint32_t place) {
            if (isMeant(pair)) { lists.found.push_back(place); }
        });
        return lists.found;
    }
    if (!lists.isListed) { listPairs(world); }
    for (const std::uint32_t shape : shapes) {
        const auto proxy = static_cast<std::size_t>(world.shapes[shape].proxy);
        if (proxy + 1 >= lists.begins.size()) { continue; }  // made since: it has no pairs yet
        for (std::uint32_t i = lists.begins[proxy]; i < lists.begins[proxy + 1]; ++i) {
            const ContactPair& pair = pairAt(world, lists.places[i]);
            if (!isGap(pair) && isMeant(pair)) { lists.found.push_back(lists.places[i]); }
        }
    }
    std::sort(lists.found.begin(), lists.found.end());
    lists.found.erase(std::unique(lists.found.begin(), lists.found.end()), lists.found.end());
    return lists.found;
}

void wakeAcross(WorldState& world, std::uint32_t body, std::span<const std::uint32_t> places) {
    for (const std::uint32_t place : places) {
        if (place >= world.probes.size()) { return; }  // candidates do not touch
        const Contact& contact = world.contacts[world.probes[place].contact];
        if (contact.isSolid()) { wake(world, contact.bodyA == body ? contact.bodyB : contact.bodyA); }
    }
}

void reportEnd(const WorldState& world, const ContactProbe& probe, std::vector<ContactEvent>& events) {
    if (probe.isIdle) { return; }
    const Contact& contact = world.contacts[probe.contact];
    if (!contact.touching) { return; }
    events.push_back({.type = contact.sensor ? ContactEventType::sensorEnd : ContactEventType::end,
                      .shapeA = world.shapes.idOf(world.shapes[contact.shapeA].head),
                      .shapeB = world.shapes.idOf(world.shapes[contact.shapeB].head),
                      .bodyA = world.bodies.idOf(contact.bodyA),
                      .bodyB = world.bodies.idOf(contact.bodyB)});
}

void removePairs(WorldState& world, std::span<const std::uint32_t> places) {
    for (const std::uint32_t place : places) {
        ContactPair& pair = pairAt(world, place);
        dropPair(world, pair);
        if (place < world.probes.size()) {
            const ContactProbe& probe = world.probes[place];
            reportEnd(world, probe, world.eventsToCome);
            const bool isParked = place >= world.activeContacts;
            if (isParked && world.contacts[probe.contact].isSolid()) { --world.parked.touching; }
        }
        pair.bodyA = pair.bodyB = kNoIndex;
    }
    world.pairsOfShapes.gaps += places.size();
}

void closeUpPairs(WorldState& world) {
    PairsOfShapes& lists = world.pairsOfShapes;
    lists.scans = 0;
    lists.isListed = false;
    if (lists.gaps == 0) { return; }
    lists.gaps = 0;
    const auto firstParked = world.probes.begin() + static_cast<std::ptrdiff_t>(world.activeContacts);
    world.activeContacts -= static_cast<std::size_t>(std::count_if(world.probes.begin(), firstParked, isGap));
    std::erase_if(world.probes, isGap);
    std::erase_if(world.candidates, isGap);
    std::erase_if(world.parked.candidates, isGap);
}

}  // namespace swept::inline SWEPT_PRECISION
