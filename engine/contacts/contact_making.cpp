#include "contact_making.h"

#include <algorithm>
#include <array>
#include <utility>

#include "../../shapes/manifold_batch.h"
#include "decks.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Gaps stay between contacts until there are so many: then two contacts are moved for each that ended.
constexpr std::size_t kContactsPerGap = 2;
constexpr std::size_t kFewGaps = 64;

/// Room per shape that moves, as much as heaps of boxes need: contacts are not moved as a heap thickens, which takes as
/// long as ten steps where pages are dear to get. (What is not used of it takes addresses alone.)
constexpr std::size_t kContactsPerShape = 12;

/// Contacts per block of a parallel loop: each asks for two shapes and two bodies all over memory.
constexpr std::size_t kMakeGrain = 16;

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
    probe.isOfDeck = contact.pieceA || contact.pieceB;
    probe.isUnseen = contact.sensor || !(world.bodies[contact.bodyA].awake || world.bodies[contact.bodyB].awake);
    probe.bounces = contact.restitution > 0;
    probe.isBelt = contact.isBelt;
    probe.resistsRolling = contact.resistsRolling;
    probe.dynamicA = contact.dynamicA;
    probe.dynamicB = contact.dynamicB;
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

Contact contactOf(const WorldState& world, std::uint32_t shapeA, std::uint32_t shapeB) {
    if (!comesFirst(world, shapeA, shapeB)) { std::swap(shapeA, shapeB); }
    const Shape& a = world.shapes[shapeA];
    const Shape& b = world.shapes[shapeB];
    Contact contact;
    contact.shapeA = shapeA;
    contact.shapeB = shapeB;
    contact.bodyA = a.body;
    contact.bodyB = b.body;
    mixSurfaces(world, contact);
    contact.extent = extentOfPair(a, b);
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
    notePieces(world, contact);
    return contact;
}

void makeContact(WorldState& world, std::uint32_t a, std::uint32_t b) {
    const std::size_t place = world.contacts.size();
    ContactProbe& probe = world.probes[makeRoomForContacts(world, 1)];
    fillContact(world, probe, place, a, b);
}

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
    world.pairs.erase(shapeOf(world, pair.proxyA), shapeOf(world, pair.proxyB));
}

void dropPairs(WorldState& world, std::span<const ContactPair> pairs) {
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i + kLookedUpAhead < pairs.size()) {
            const ContactPair& coming = pairs[i + kLookedUpAhead];
            world.pairs.fetch(shapeOf(world, coming.proxyA), shapeOf(world, coming.proxyB));
        }
        dropPair(world, pairs[i]);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
