#include "pairs_of_shapes.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <vector>

#include "../bodies/awake.h"
#include "../bodies/body_joints.h"
#include "../state/world_state.h"
#include "contact_making.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// To list the pairs of all shapes takes as long as two looks at all pairs.
constexpr int kScansBeforeLists = 2;

/// Where the places of each list begin; those of the probes at 0. All contacts come before all candidates.
struct Places {
    std::size_t parkedProbes = 0;
    std::size_t candidates = 0;
    std::size_t parkedCandidates = 0;
};

Places placesIn(const WorldState& world) {
    Places begins;
    begins.parkedProbes = world.probes.size();
    begins.candidates = begins.parkedProbes + world.parked.probes.all().size();
    begins.parkedCandidates = begins.candidates + world.candidates.size();
    return begins;
}

/// Calls `visit` with each pair that is not parked, and no gap, and its place, in order.
template <class Visit>
void forEachPair(WorldState& world, const Visit& visit) {
    const auto go = [&](auto& pairs, std::size_t place) {
        for (ContactPair& pair : pairs) {
            if (!isGap(pair)) { visit(pair, static_cast<std::uint32_t>(place)); }
            ++place;
        }
    };
    go(world.probes, 0);
    go(world.candidates, placesIn(world).candidates);
}

ContactPair& pairAt(WorldState& world, std::size_t place) {
    const Places begins = placesIn(world);
    if (ContactProbe* const probe = probeAt(world, place)) { return *probe; }
    if (place < begins.parkedCandidates) { return world.candidates[place - begins.candidates]; }
    return world.parked.candidates[static_cast<std::uint32_t>(place - begins.parkedCandidates)];
}

std::array<std::size_t, 2> proxiesOf(const ContactPair& pair) {
    return {static_cast<std::size_t>(pair.proxyA), static_cast<std::size_t>(pair.proxyB)};
}

/// Lists count as made once they are: memory may run out meanwhile.
class ListMaker {
public:
    explicit ListMaker(PairsOfShapes& lists) : state_(lists.state) {}
    ListMaker(const ListMaker&) = delete;
    ListMaker& operator=(const ListMaker&) = delete;
    ~ListMaker() { state_.store(end_, std::memory_order_release); }
    void finish() { end_ = ListState::listed; }

private:
    CopiedAtomic<ListState>& state_;
    ListState end_ = ListState::none;
};

/// Sorts places by proxy, by counting. @pre `state` is `beingMade`, by this thread
void listPairs(WorldState& world) {
    PairsOfShapes& lists = world.pairsOfShapes;
    ListMaker maker(lists);
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
    maker.finish();
}

/// Whether the lists are there: the third one who asks makes them. While another thread does, nobody waits for it.
bool areListed(WorldState& world) {
    PairsOfShapes& lists = world.pairsOfShapes;
    ListState state = lists.state.load(std::memory_order_acquire);
    if (state != ListState::none) { return state == ListState::listed; }
    if (lists.scans.fetch_add(1, std::memory_order_relaxed) < kScansBeforeLists) { return false; }
    if (!lists.state.compare_exchange_strong(state, ListState::beingMade, std::memory_order_acquire)) {
        return state == ListState::listed;
    }
    listPairs(world);
    return true;
}

/// Those of the parked pairs of a shape that are meant.
void addParked(WorldState& world, std::uint32_t shape, FunctionRef<bool(const ContactPair&)> isMeant,
               std::vector<std::uint32_t>& found) {
    const Places begins = placesIn(world);
    const auto add = [&](auto& pairs, std::size_t begin) {
        pairs.visitOf(world.shapes[shape].proxy, [&](std::uint32_t place) {
            if (isMeant(pairs[place])) { found.push_back(static_cast<std::uint32_t>(begin + place)); }
        });
    };
    add(world.parked.probes, begins.parkedProbes);
    add(world.parked.candidates, begins.parkedCandidates);
}

/// Of the pairs of a shape that are not parked. @pre listed
void addListed(WorldState& world, std::uint32_t shape, FunctionRef<bool(const ContactPair&)> isMeant,
               std::vector<std::uint32_t>& found) {
    const PairsOfShapes& lists = world.pairsOfShapes;
    if (world.shapes[shape].proxy == kNoProxy) { return; }
    const auto proxy = static_cast<std::size_t>(world.shapes[shape].proxy);
    if (proxy + 1 >= lists.begins.size()) { return; }  // made since: it has no pairs yet
    for (std::uint32_t i = lists.begins[proxy]; i < lists.begins[proxy + 1]; ++i) {
        const ContactPair& pair = pairAt(world, lists.places[i]);
        if (!isGap(pair) && isMeant(pair)) { found.push_back(lists.places[i]); }
    }
}

}  // namespace

ContactProbe* probeAt(WorldState& world, std::size_t place) {
    const Places begins = placesIn(world);
    if (place < begins.parkedProbes) { return &world.probes[place]; }
    if (place >= begins.candidates) { return nullptr; }
    return &world.parked.probes[static_cast<std::uint32_t>(place - begins.parkedProbes)];
}

void findPairsOf(WorldState& world, std::span<const std::uint32_t> shapes,
                 FunctionRef<bool(const ContactPair&)> isMeant, std::vector<std::uint32_t>& found) {
    found.clear();
    if (areListed(world)) {
        for (const std::uint32_t shape : shapes) { addListed(world, shape, isMeant, found); }
    } else {
        forEachPair(world, [&](const ContactPair& pair, std::uint32_t place) {
            if (isMeant(pair)) { found.push_back(place); }
        });
    }
    for (const std::uint32_t shape : shapes) { addParked(world, shape, isMeant, found); }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

std::span<const std::uint32_t> pairsOf(WorldState& world, std::span<const std::uint32_t> shapes,
                                       FunctionRef<bool(const ContactPair&)> isMeant) {
    findPairsOf(world, shapes, isMeant, world.pairsOfShapes.found);
    return world.pairsOfShapes.found;
}

void listSlots(const WorldState& world, std::uint32_t head, std::vector<std::uint32_t>& slots) {
    slots.clear();
    for (std::uint32_t slot = head; slot != kNoIndex; slot = world.shapes[slot].nextInChain) { slots.push_back(slot); }
}

void findPairsOfShape(WorldState& world, std::span<const std::uint32_t> slots, std::vector<std::uint32_t>& found) {
    const std::uint32_t body = world.shapes[slots.front()].body;
    const auto isOfShape = [&world, head = slots.front()](ProxyId proxy) {
        return world.shapes[world.proxyShapes[static_cast<std::size_t>(proxy)]].head == head;
    };
    const auto isMeant = [&](const ContactPair& pair) {
        return (pair.bodyA == body && isOfShape(pair.proxyA)) || (pair.bodyB == body && isOfShape(pair.proxyB));
    };
    findPairsOf(world, slots, isMeant, found);
}

std::span<const std::uint32_t> pairsOfShape(WorldState& world, std::span<const std::uint32_t> slots) {
    findPairsOfShape(world, slots, world.pairsOfShapes.found);
    return world.pairsOfShapes.found;
}

std::span<const std::uint32_t> pairsBetween(WorldState& world, const Joint& joint) {
    const auto isSensor = [&world](ProxyId proxy) {
        return world.shapes[world.proxyShapes[static_cast<std::size_t>(proxy)]].def.sensor;
    };
    const auto isBetween = [&isSensor, a = joint.bodyA, b = joint.bodyB](const ContactPair& c) {
        const bool connects = (c.bodyA == a && c.bodyB == b) || (c.bodyA == b && c.bodyB == a);
        return connects && !isSensor(c.proxyA) && !isSensor(c.proxyB);
    };
    return pairsOf(world, world.bodies[bodyOfFewerShapes(world, joint)].shapes, isBetween);
}

void wakeAcross(WorldState& world, std::uint32_t body, std::span<const std::uint32_t> places) {
    const bool isFixed = world.bodies[body].def.type == BodyType::fixed;
    for (const std::uint32_t place : places) {
        const ContactProbe* const probe = probeAt(world, place);
        if (probe == nullptr) { return; }  // candidates do not touch
        const Contact& contact = world.contacts[probe->contact];
        if (!contact.isSolid()) { continue; }
        const std::uint32_t other = contact.bodyA == body ? contact.bodyB : contact.bodyA;
        if (isFixed) {
            rouseToRest(world, other);  // ground that is replaced by the same carries it in the next step
        } else {
            rouse(world, other);
        }
    }
}

void dropContacts(WorldState& world, std::uint32_t slot) {
    const std::span<const std::uint32_t> places =
        pairsOf(world, world.bodies[slot].shapes,
                [slot](const ContactPair& pair) { return pair.bodyA == slot || pair.bodyB == slot; });
    wakeAcross(world, slot, places);
    wakeJoined(world, slot);
    removePairs(world, places);
    std::erase_if(world.crossed, [&world, slot](const ChainPasser& passer) {
        return world.shapes[passer.shape].body == slot || world.shapes[passer.segment].body == slot;
    });
}

void reportEnd(const WorldState& world, const ContactProbe& probe, std::vector<ContactEvent>& events) {
    if (probe.isIdle) { return; }
    const Contact& contact = world.contacts[probe.contact];
    if (!contact.touching) { return; }
    const Shape& a = world.shapes[contact.shapeA];
    const Shape& b = world.shapes[contact.shapeB];
    events.push_back({.type = contact.sensor ? ContactEventType::sensorEnd : ContactEventType::end,
                      .shapeA = world.shapes.idOf(a.head),
                      .shapeB = world.shapes.idOf(b.head),
                      .bodyA = world.bodies.idOf(contact.bodyA),
                      .bodyB = world.bodies.idOf(contact.bodyB),
                      .segmentA = a.segmentIndex,
                      .segmentB = b.segmentIndex,
                      .userDataA = a.def.userData,
                      .userDataB = b.def.userData,
                      .bodyUserDataA = world.bodies[contact.bodyA].def.userData,
                      .bodyUserDataB = world.bodies[contact.bodyB].def.userData});
}

void removePairs(WorldState& world, std::span<const std::uint32_t> places) {
    const Places begins = placesIn(world);
    for (const std::uint32_t place : places) {
        ContactPair& pair = pairAt(world, place);
        dropPair(world, pair);
        if (const ContactProbe* const probe = probeAt(world, place)) {
            reportEnd(world, *probe, world.eventsToCome);
            const bool isParked = place >= begins.parkedProbes;
            if (isParked && world.contacts[probe->contact].isSolid()) { --world.parked.touching; }
        }
        if (place >= begins.parkedCandidates) {
            world.parked.candidates.erase(static_cast<std::uint32_t>(place - begins.parkedCandidates));
        } else if (place >= begins.parkedProbes && place < begins.candidates) {
            world.parked.probes.erase(static_cast<std::uint32_t>(place - begins.parkedProbes));
        } else {
            makeGap(pair);
            ++world.pairsOfShapes.gaps;
        }
    }
}

void closeUpPairs(WorldState& world) {
    PairsOfShapes& lists = world.pairsOfShapes;
    lists.scans = 0;
    lists.state = ListState::none;
    if (lists.gaps == 0) { return; }
    lists.gaps = 0;
    std::erase_if(world.probes, isGap);
    std::erase_if(world.candidates, isGap);
}

}  // namespace swept::inline SWEPT_PRECISION
