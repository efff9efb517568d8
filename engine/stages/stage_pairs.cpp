#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "../../shapes/manifold_batch.h"
#include "../contacts/pair_boxes.h"
#include "../contacts/travel.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Gaps stay between contacts until there are so many: then two contacts are moved for each that ended.
constexpr std::size_t kContactsPerGap = 2;
constexpr std::size_t kFewGaps = 64;

/// Pairs that are looked up in the table ahead of time: each is a cache line of its own.
constexpr std::size_t kLookedUpAhead = 8;

/// Sensors come first, then chain segments, then what does not yield, else the lower slot.
bool comesFirst(const WorldState& world, std::uint32_t a, std::uint32_t b) {
    const Shape& shapeA = world.shapes[a];
    const Shape& shapeB = world.shapes[b];
    if (shapeA.def.sensor != shapeB.def.sensor) { return shapeA.def.sensor; }
    if (shapeA.isChainSegment != shapeB.isChainSegment) { return shapeA.isChainSegment; }
    const bool aYields = world.bodies[shapeA.body].isDynamic();
    if (aYields != world.bodies[shapeB.body].isDynamic()) { return !aYields; }
    return a < b;
}

BatchKind batchKindOf(const Shape& first, const Shape& second) {
    if (!first.isBatched || !second.isBatched || second.isChainSegment) { return BatchKind::none; }
    const Polygon& a = first.polygon;
    const Polygon& b = second.polygon;
    const int vertices = std::max(a.count, b.count);
    const bool areFew = vertices <= kFewVertices;
    if (first.isChainSegment) {
        if (vertices <= 2) { return BatchKind::chainTwo; }
        return areFew ? BatchKind::chainFew : BatchKind::chainMany;
    }
    if (pairKindOf(a, b) == PairKind::sharp) { return areFew ? BatchKind::few : BatchKind::many; }
    if (!areFew) { return BatchKind::roundMany; }
    using enum BatchKind;
    static constexpr std::array<std::array<BatchKind, 3>, 3> kRound{
        {{circles, roundTwo, circleFew}, {roundTwo, roundTwo, twoFew}, {fewCircle, fewTwo, roundFew}}};
    const auto sideOf = [](const Polygon& polygon) { return static_cast<std::size_t>(std::min(polygon.count, 3) - 1); };
    return kRound[sideOf(a)][sideOf(b)];
}

}  // namespace

void mixSurfaces(const WorldState& world, Contact& contact) {
    const Shape& shapeA = world.shapes[contact.shapeA];
    const Shape& shapeB = world.shapes[contact.shapeB];
    const ShapeDef& a = shapeA.def;
    const ShapeDef& b = shapeB.def;
    contact.friction = mixedFriction(a, b);
    contact.restitution = mixedRestitution(a, b);
    contact.isBelt = contact.friction > 0 && mixedSpeed(a, b) != 0;
    contact.resistsRolling = mixedRolling(shapeA, shapeB) > 0;
}

MixedSurface surfaceOf(const WorldState& world, const Contact& contact) {
    if (!contact.isBelt && !contact.rolls()) { return {contact.friction, contact.restitution}; }
    const Shape& a = world.shapes[contact.shapeA];
    const Shape& b = world.shapes[contact.shapeB];
    MixedSurface surface = mixedSurface(a.def, b.def);
    if (contact.rolls()) { surface.rolling = mixedRolling(a, b); }
    return surface;
}

Contact contactOf(const WorldState& world, std::uint32_t first, std::uint32_t second) {
    if (!comesFirst(world, first, second)) { std::swap(first, second); }
    const Shape& a = world.shapes[first];
    const Shape& b = world.shapes[second];
    Contact contact;
    contact.shapeA = first;
    contact.shapeB = second;
    contact.bodyA = a.body;
    contact.bodyB = b.body;
    mixSurfaces(world, contact);
    contact.extent = std::min(a.extent, b.extent);
    contact.extentA = a.extent;
    contact.extentB = b.extent;
    contact.radiusA = a.polygon.radius;
    contact.radiusB = b.polygon.radius;
    contact.verticesA = static_cast<std::uint8_t>(a.polygon.count);
    contact.verticesB = static_cast<std::uint8_t>(b.polygon.count);
    contact.dynamicA = world.bodies[a.body].isDynamic();
    contact.dynamicB = world.bodies[b.body].isDynamic();
    contact.sensor = a.def.sensor;
    contact.ofChain = a.isChainSegment && !contact.sensor;
    contact.batch = batchKindOf(a, b);
    return contact;
}

void closeGaps(WorldState& world) {
    const std::size_t count = world.probes.size() + world.parked.probes.size();
    if (world.contacts.size() <= count + count / kContactsPerGap + kFewGaps) { return; }
    world.probesThere.assign(world.contacts.size(), nullptr);
    for (ContactProbe& probe : world.probes) { world.probesThere[probe.contact] = &probe; }
    for (ContactProbe& probe : world.parked.probes.all()) {
        if (!isGap(probe)) { world.probesThere[probe.contact] = &probe; }
    }
    std::uint32_t kept = 0;
    for (std::uint32_t place = 0; place < world.contacts.size(); ++place) {
        if (world.probesThere[place] == nullptr) { continue; }
        world.probesThere[place]->contact = kept;
        if (kept != place) { world.contacts[kept] = world.contacts[place]; }
        ++kept;
    }
    world.contacts.resize(kept);
}

void dropPair(WorldState& world, const ContactPair& pair) {
    world.pairs.erase(world.proxyShapes[static_cast<std::size_t>(pair.proxyA)],
                      world.proxyShapes[static_cast<std::size_t>(pair.proxyB)]);
}

void dropPairs(WorldState& world, std::span<const ContactPair> pairs) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i + kLookedUpAhead < pairs.size()) {
            const ContactPair& coming = pairs[i + kLookedUpAhead];
            world.pairs.fetch(world.proxyShapes[static_cast<std::size_t>(coming.proxyA)],
                              world.proxyShapes[static_cast<std::size_t>(coming.proxyB)]);
        }
        dropPair(world, pairs[i]);
    }
}

namespace {

/// Room per shape that moves, as much as heaps of boxes need: contacts are not moved as a heap thickens, which takes as
/// long as ten steps where pages are dear to get. (What is not used of it takes addresses alone.)
constexpr std::size_t kContactsPerShape = 12;

/// Those of bodies that forces move.
std::size_t countMovingShapes(const WorldState& world) {
    std::size_t count = 0;
    for (std::uint32_t slot = 0; slot < world.shapes.slotCount(); ++slot) {
        count += world.shapes.isAlive(slot) && world.bodies[world.shapes[slot].body].isDynamic() ? 1 : 0;
    }
    return count;
}

/// Makes room for contacts, which come last. @return place of the first of their probes
std::size_t makeRoomForContacts(WorldState& world, std::size_t count) {
    const std::size_t first = world.probes.size();
    const std::size_t needed = world.contacts.size() + count;
    if (needed > world.contacts.capacity()) {
        const std::size_t room = std::max(2 * needed, kContactsPerShape * countMovingShapes(world));
        world.contacts.reserve(room);
        world.probes.reserve(room);
    }
    world.probes.resize(first + count);
    world.contacts.resize(world.contacts.size() + count);
    return first;
}

void fillContact(WorldState& world, ContactProbe& probe, std::size_t place, std::uint32_t a, std::uint32_t b) {
    probe.contact = static_cast<std::uint32_t>(place);
    const Contact& contact = world.contacts[place] = contactOf(world, a, b);
    probe.bodyA = contact.bodyA;
    probe.bodyB = contact.bodyB;
    probe.proxyA = world.shapes[contact.shapeA].proxy;
    probe.proxyB = world.shapes[contact.shapeB].proxy;
    probe.isPlain = contact.dynamicA && contact.dynamicB && !contact.sensor;
    probe.isUnseen = contact.sensor;
    probe.bounces = contact.restitution > 0;
    probe.isBelt = contact.isBelt;
    probe.resistsRolling = contact.resistsRolling;
    probe.dynamicA = contact.dynamicA;
    probe.dynamicB = contact.dynamicB;
}

void makeContact(WorldState& world, std::uint32_t a, std::uint32_t b) {
    const std::size_t place = world.contacts.size();
    ContactProbe& probe = world.probes[makeRoomForContacts(world, 1)];
    fillContact(world, probe, place, a, b);
}

std::uint32_t shapeOf(const WorldState& world, ProxyId proxy) {
    return world.proxyShapes[static_cast<std::size_t>(proxy)];
}

/// Contacts per block of a parallel loop: each asks for two shapes and two bodies all over memory.
constexpr std::size_t kMakeGrain = 16;

/// In the order of the pairs.
void makeContacts(WorldState& world, std::span<const ContactPair> pairs) {
    const std::size_t place = world.contacts.size();
    const std::size_t first = makeRoomForContacts(world, pairs.size());
    world.loops->run(pairs.size(), kMakeGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            fillContact(world, world.probes[first + i], place + i, shapeOf(world, pairs[i].proxyA),
                        shapeOf(world, pairs[i].proxyB));
        }
    });
}

/// Nobody asks about such a pair before it is near: what kinematic bodies may meet is looked for farther away, and
/// those that bounce off each other in flight ask for theirs (clash.h).
bool mayWait(const WorldState& world, const Shape& a, const Shape& b) {
    return !world.watched && !a.def.sensor && !b.def.sensor && world.bodies[a.body].isDynamic() &&
           world.bodies[b.body].isDynamic();
}

/// Nothing moves here, and yet the two met: something was put there. A kinematic body at rest wakes nobody, but what is
/// held is awake to the user.
void releaseWhatIsMet(WorldState& world, std::uint32_t a, std::uint32_t b) {
    if (disturbs(world, a) || disturbs(world, b)) { return; }
    for (const std::uint32_t slot : {a, b}) {
        if (world.bodies[slot].heldIn != kNoIndex) { releaseHeld(world, slot); }
    }
}

NewPair newPairOf(const WorldState& world, std::uint32_t a, std::uint32_t b) {
    const Shape& first = world.shapes[a];
    const Shape& second = world.shapes[b];
    NewPair pair;
    pair.shapeA = a;
    pair.shapeB = b;
    pair.bodyA = first.body;
    pair.bodyB = second.body;
    pair.proxyA = first.proxy;
    pair.proxyB = second.proxy;
    pair.mayTouch = mayTouch(world, first, second);
    if (!pair.mayTouch) { return pair; }
    pair.mayWait = mayWait(world, first, second);
    pair.isKnown = disturbs(world, first.body) || disturbs(world, second.body);
    return pair;
}

/// @return false when the two may not touch, or have a contact already
bool addPair(WorldState& world, const NewPair& pair, bool isNear) {
    if (!pair.mayTouch || !world.pairs.insert(pair.shapeA, pair.shapeB)) { return false; }
    if (!isNear && pair.mayWait) {
        world.candidates.push_back(pair);
    } else {
        makeContact(world, pair.shapeA, pair.shapeB);
    }
    ++world.counters.pairsFound;
    return true;
}

/// New pairs per block of a parallel loop, likewise.
constexpr std::size_t kNewPairGrain = 32;

}  // namespace

bool addContact(WorldState& world, std::uint32_t a, std::uint32_t b) {
    const NewPair pair = newPairOf(world, a, b);
    if (!addPair(world, pair, true)) { return false; }
    if (!pair.isKnown) { releaseWhatIsMet(world, pair.bodyA, pair.bodyB); }
    return true;
}

void findPairs(WorldState& world) {
    const std::uint64_t testsBefore = world.broadphase->counters().boxTests;
    world.broadphase->pairs(world.newPairs, *world.loops);
    world.counters.boxTests = world.broadphase->counters().boxTests - testsBefore;
    std::vector<NewPair>& found = world.newPairKinds;
    found.resize(world.newPairs.size());
    world.loops->run(found.size(), kNewPairGrain, [&world, &found](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const ProxyPair& pair = world.newPairs[i];
            found[i] = newPairOf(world, shapeOf(world, pair.a), shapeOf(world, pair.b));
        }
    });
}

void addPairs(WorldState& world) {
    const std::vector<NewPair>& found = world.newPairKinds;
    world.metPairs.clear();
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i + kLookedUpAhead < found.size()) {
            const NewPair& coming = found[i + kLookedUpAhead];
            world.pairs.fetch(coming.shapeA, coming.shapeB);
        }
        if (addPair(world, found[i], false) && !found[i].isKnown) { world.metPairs.push_back(found[i]); }
    }
}

void releaseMet(WorldState& world) {
    for (const ContactPair& pair : world.metPairs) { releaseWhatIsMet(world, pair.bodyA, pair.bodyB); }
    world.metPairs.clear();
}

namespace {

/// Pairs per block of a parallel loop.
constexpr std::size_t kCandidateGrain = 512;

CandidateFate fateOf(const WorldState& world, std::span<const Aabb> boxes, const ContactPair& pair) {
    const bool isNear = boxesOverlap(world.neededBoxes, pair);
    if (!world.watched && !isNear && boxesOverlap(boxes, pair)) { return CandidateFate::waits; }  // as nearly always
    const BodyGlances bodies{world.glances[pair.bodyA], world.glances[pair.bodyB]};
    const bool isAsleep = bodies.a.motion < 0 && bodies.b.motion < 0;
    if (!isAsleep && !boxesOverlap(boxes, pair)) { return CandidateFate::goes; }
    const bool isContact = world.watched || (isNear && !isAsleep && !bodies.areFar());
    return isContact ? CandidateFate::becomesContact : CandidateFate::waits;
}

/// The first from a place on that does not wait: few do not.
std::size_t nextThatLeaves(std::span<const CandidateFate> fates, std::size_t from) {
    static_assert(static_cast<int>(CandidateFate::waits) == 0);
    for (std::uint64_t several = 0; from + sizeof(several) <= fates.size(); from += sizeof(several)) {
        std::memcpy(&several, fates.data() + from, sizeof(several));
        if (several != 0) { break; }
    }
    while (from < fates.size() && fates[from] == CandidateFate::waits) { ++from; }
    return from;
}

}  // namespace

void promoteCandidates(WorldState& world) {
    const std::span<const Aabb> boxes = world.broadphase->boxes();
    world.droppedPairs.clear();
    world.promoted.clear();
    world.candidateFates.resize(world.candidates.size());
    world.loops->run(world.candidates.size(), kCandidateGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            world.candidateFates[i] = fateOf(world, boxes, world.candidates[i]);
        }
    });
    std::size_t leaves = nextThatLeaves(world.candidateFates, 0);
    while (leaves < world.candidates.size()) {
        const bool goes = world.candidateFates[leaves] == CandidateFate::goes;
        (goes ? world.droppedPairs : world.promoted).push_back(world.candidates[leaves]);
        leaves = nextThatLeaves(world.candidateFates, leaves + 1);
    }
    makeContacts(world, world.promoted);
}

void closeCandidates(WorldState& world) {
    const std::span<ContactPair> candidates = world.candidates;
    std::size_t leaves = nextThatLeaves(world.candidateFates, 0);
    std::size_t kept = leaves;
    while (leaves < candidates.size()) {
        const std::size_t next = nextThatLeaves(world.candidateFates, leaves + 1);
        std::copy(&candidates[leaves] + 1, candidates.data() + next, candidates.data() + kept);
        kept += next - leaves - 1;
        leaves = next;
    }
    world.candidates.resize(kept);
    dropPairs(world, world.droppedPairs);
}

void promoteCandidatesOf(WorldState& world, FunctionRef<bool(const ContactPair&)> isMeant) {
    std::size_t kept = 0;
    for (const ContactPair& pair : world.candidates) {
        if (isMeant(pair)) {
            makeContact(world, shapeOf(world, pair.proxyA), shapeOf(world, pair.proxyB));
        } else {
            world.candidates[kept++] = pair;
        }
    }
    world.candidates.resize(kept);
}

}  // namespace swept::inline SWEPT_PRECISION
