#include <algorithm>
#include <cmath>

#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

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

}  // namespace

Contact contactOf(const WorldState& world, std::uint32_t first, std::uint32_t second) {
    if (!comesFirst(world, first, second)) { std::swap(first, second); }
    const Shape& a = world.shapes[first];
    const Shape& b = world.shapes[second];
    Contact contact;
    contact.shapeA = first;
    contact.shapeB = second;
    contact.bodyA = a.body;
    contact.bodyB = b.body;
    // Product of the roots: unlike the root of the product it cannot overflow, and scales the same.
    contact.friction = std::sqrt(a.def.friction) * std::sqrt(b.def.friction);
    contact.restitution = std::max(a.def.restitution, b.def.restitution);
    contact.extent = std::min(a.extent, b.extent);
    contact.extentA = a.extent;
    contact.extentB = b.extent;
    contact.dynamicA = world.bodies[a.body].isDynamic();
    contact.dynamicB = world.bodies[b.body].isDynamic();
    contact.sensor = a.def.sensor;
    return contact;
}

bool addContact(WorldState& world, std::uint32_t a, std::uint32_t b) {
    if (!mayTouch(world, world.shapes[a], world.shapes[b]) || !world.pairs.insert(a, b)) { return false; }
    const Contact& contact = world.contacts.emplace_back(contactOf(world, a, b));
    world.probes.push_back({.bodyA = contact.bodyA,
                            .bodyB = contact.bodyB,
                            .proxyA = world.shapes[contact.shapeA].proxy,
                            .proxyB = world.shapes[contact.shapeB].proxy});
    ++world.counters.pairsFound;
    return true;
}

void findPairs(WorldState& world) {
    const std::uint64_t testsBefore = world.broadphase->counters().boxTests;
    world.broadphase->pairs(world.newPairs);
    world.counters.boxTests = world.broadphase->counters().boxTests - testsBefore;
    for (const ProxyPair& pair : world.newPairs) {
        addContact(world, world.proxyShapes[static_cast<std::uint32_t>(pair.a)],
                   world.proxyShapes[static_cast<std::uint32_t>(pair.b)]);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
