#include "island_contacts.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "../contacts/chain_passage.h"
#include "../contacts/contact_batch.h"
#include "../contacts/contact_making.h"
#include "../contacts/contact_manifold.h"
#include "../contacts/decks.h"
#include "../contacts/ghosts.h"
#include "../contacts/may_touch.h"
#include "../contacts/new_pairs.h"
#include "../contacts/slides.h"
#include "../containers/boxed_items.h"
#include "../flight/bullets_ahead.h"
#include "../flight/ground_on_the_way.h"
#include "../state/tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void listHeldPairs(AdvancingIsland& island) {
    island.pairs.clear();
    for (const Contact& contact : island.contacts) {
        island.pairs.push_back(PairTable::keyOf(contact.shapeA, contact.shapeB));
    }
    std::sort(island.pairs.begin(), island.pairs.end());
}

Real reachWithin(const WorldState& world, const Shape& shape, Real time) {
    if (world.bodies[shape.body].def.type == BodyType::fixed) { return 0; }
    return reachOfMotion(motionBound(world, shape.body, time), shape.extent, false);
}

/// Static and kinematic shapes within reach that no contact knows yet.
void findGround(WorldState& world, AdvancingIsland& island, const Shape& own, std::uint32_t slot, Real time,
                GroundOnTheWay* ground) {
    const Aabb box = boundsOf(own.polygon, world.motions[own.body].pose);
    island.found.clear();
    world.broadphase->queryGround(grown(box, reachWithin(world, own, time)), [&](ProxyId id) {
        island.found.push_back(world.proxyShapes[static_cast<std::uint32_t>(id)]);
        return true;
    });
    std::sort(island.found.begin(), island.found.end());
    for (const std::uint32_t found : island.found) {
        const Shape& other = world.shapes[found];
        if (world.bodies[other.body].isDynamic() || other.def.sensor || !mayTouch(world, own, other)) { continue; }
        const std::uint64_t key = PairTable::keyOf(slot, found);
        const auto place = std::lower_bound(island.pairs.begin(), island.pairs.end(), key);
        if (place != island.pairs.end() && *place == key) { continue; }
        if (ground != nullptr) { ground->meet(other.body); }
        island.pairs.insert(place, key);
        island.contacts.push_back(contactOf(world, slot, found));
        island.sources.push_back(kNoIndex);
    }
}

/// What a member comes up to counts as met from half of that on, and so does what comes up to it.
Real nearOf(const Shape& shape) { return kEndRatio * shape.extent; }

void listBoxed(WorldState& world, AdvancingIsland& island) {
    island.boxed.clear();
    for (const std::uint32_t member : island.members) {
        const bool asks = meetsMembers(world, member);
        for (const std::uint32_t slot : world.bodies[member].shapes) {
            const Shape& shape = world.shapes[slot];
            const Aabb box = grown(boundsOf(shape.polygon, world.motions[member].pose), nearOf(shape) / 2);
            if (!shape.def.sensor && overlaps(box, box)) { island.boxed.push_back({box, slot, asks}); }
        }
    }
}

/// Members that bullets which joints hold have come up to, and that no contact knows yet: what sweeps met is as near as
/// that. What is farther away may yet pass by.
void findMembersMet(WorldState& world, AdvancingIsland& island) {
    listBoxed(world, island);
    island.metPairs.clear();
    forEachOverlap(island.boxed, [&](std::uint32_t own, std::uint32_t met) {
        const Shape& shape = world.shapes[own];
        const Shape& other = world.shapes[met];
        if (shape.body == other.body || !mayTouch(world, shape, other)) { return; }
        const std::uint64_t key = PairTable::keyOf(own, met);
        if (!std::binary_search(island.pairs.begin(), island.pairs.end(), key)) { island.metPairs.push_back(key); }
    });
    std::sort(island.metPairs.begin(), island.metPairs.end());
    for (const std::uint64_t key : island.metPairs) {
        island.contacts.push_back(
            contactOf(world, static_cast<std::uint32_t>(key >> 32), static_cast<std::uint32_t>(key)));
        island.sources.push_back(kNoIndex);
    }
}

/// Normal impulse that a point of a contact had at the start of the step, N·s in a sub-step of the usual length.
Real carriedAtStart(const WorldState& world, const AdvancingIsland& island, std::size_t index, FeatureId id) {
    const std::uint32_t source = island.sources[index];
    if (source == kNoIndex) { return 0; }
    const Contact& start = world.contacts[source];
    for (std::size_t k = 0; k < static_cast<std::size_t>(start.manifold.count); ++k) {
        if (start.manifold.points[k].id == id) { return start.normalImpulse[k]; }
    }
    return 0;
}

/// The impulse of what gets out of reach in the parts to come is told by these.
void rememberPoints(AdvancingIsland& island) {
    island.pointsBefore.resize(island.contacts.size());
    for (std::size_t i = 0; i < island.contacts.size(); ++i) {
        if (island.contacts[i].manifold.count > 0) { island.pointsBefore[i] = island.contacts[i].manifold; }
    }
}

bool hasPressed(const Contact& contact) { return contact.totalImpulse[0] > 0 || contact.totalImpulse[1] > 0; }

/// An impulse is told by the points of its contact, however many of them are left.
void tellImpulse(Contact& contact, const Manifold& pointsBefore) {
    if (contact.manifold.count == 0) {
        contact.manifold = pointsBefore;
        contact.isKept = false;  // that is of another pose
        contact.normalImpulse = contact.tangentImpulse = {};
    }
    if (contact.manifold.count == 1) { contact.totalImpulse = {contact.totalImpulse[0] + contact.totalImpulse[1], 0}; }
}

}  // namespace

void collideIslandContacts(WorldState& world, IslandDesk& desk, double time, GroundOnTheWay* ground) {
    AdvancingIsland& island = desk.island;
    const auto length = static_cast<Real>(time);
    listHeldPairs(island);
    for (const std::uint32_t member : island.members) {
        for (const std::uint32_t slot : world.bodies[member].shapes) {
            const Shape& own = world.shapes[slot];
            if (!own.def.sensor) { findGround(world, island, own, slot, length, ground); }
        }
    }
    if (mayMembersMeet(world, island.members)) { findMembersMet(world, island); }
    rememberPoints(island);
    island.slides.resize(island.contacts.size());
    ContactBatches batches(world, [](ContactProbe*, const Contact&, const Transform&) {});
    for (std::size_t i = 0; i < island.contacts.size(); ++i) {
        Contact& contact = island.contacts[i];
        const Transform bInA = relativePoseOf(world, contact);
        const Real reach = reachWithin(world, world.shapes[contact.shapeA], length) +
                           reachWithin(world, world.shapes[contact.shapeB], length);
        noteSlide(island.slides[i], contact, bInA);
        batches.add(nullptr, contact, bInA, {reach, reach});
    }
    batches.finish();
    std::vector<std::uint32_t>& all = island.indices;
    while (all.size() < island.contacts.size()) { all.push_back(static_cast<std::uint32_t>(all.size())); }
    const std::span<const std::uint32_t> renewed = std::span(all).first(island.contacts.size());
    letThrough(world, island.contacts, renewed, Moment::partBegins, island.crossing, island.chainContacts);
    dropGhosts(world, island.contacts, island.slides, renewed, island.members, island.nextGroundContact,
               world.serialTasks);
    (void)dropGhostsOfDecks(world, island.contacts, renewed, island.deckContacts);
    desk.counters.manifolds += island.contacts.size();
}

void setSubStep(const WorldState& world, AdvancingIsland& island, double seconds) {
    const auto factor = static_cast<Real>(seconds / island.subStep);
    const auto share = static_cast<Real>(seconds / island.usualSubStep);
    island.subStep = seconds;
    if (factor == 1) { return; }
    for (std::size_t i = 0; i < island.contacts.size(); ++i) {
        Contact& contact = island.contacts[i];
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.manifold.count); ++k) {
            const Real before = contact.normalImpulse[k];
            if (!(before > 0)) { continue; }
            Real now = before * factor;
            if (factor > 1) {
                const Real carried = carriedAtStart(world, island, i, contact.manifold.points[k].id);
                now = std::min(now, std::max(before, share * carried));
            }
            contact.normalImpulse[k] = now;
            contact.tangentImpulse[k] *= now / before;
            if (contact.rolls()) { contact.rollingImpulse() *= now / before; }
        }
    }
}

void putTotalsAside(AdvancingIsland& island) {
    island.totals.clear();
    for (Contact& contact : island.contacts) {
        island.totals.push_back(contact.totalImpulse);
        contact.totalImpulse = {};
    }
}

void addUpTotals(AdvancingIsland& island) {
    for (std::size_t i = 0; i < island.contacts.size(); ++i) {
        for (std::size_t k = 0; k < 2; ++k) { island.contacts[i].totalImpulse[k] += island.totals[i][k]; }
    }
}

void rememberIslandContacts(AdvancingIsland& island, bool isFirstPart) {
    if (!isFirstPart) { island.contactsBefore = island.contacts; }
}

void takeBackIslandContacts(const WorldState& world, AdvancingIsland& island, bool isFirstPart) {
    if (!isFirstPart) {
        island.contacts = island.contactsBefore;
        island.sources.resize(island.contacts.size());
        return;
    }
    island.sources.resize(island.sourceProbes.size());
    island.contacts.clear();
    for (const std::uint32_t source : island.sources) { island.contacts.push_back(world.contacts[source]); }
}

void storeIslandContacts(WorldState& world, IslandDesk& desk) {
    AdvancingIsland& island = desk.island;
    const Manifold none;
    for (std::size_t i = 0; i < island.contacts.size(); ++i) {
        Contact& contact = island.contacts[i];
        const bool isTold = hasPressed(contact);
        if (isTold) { tellImpulse(contact, i < island.pointsBefore.size() ? island.pointsBefore[i] : none); }
        if (island.sources[i] == kNoIndex) {
            if (isTold) { desk.found.push_back(contact); }
            continue;
        }
        world.contacts[island.sources[i]] = contact;
        ContactProbe& probe = world.probes[island.sourceProbes[i]];
        probe.apartUntil = 0;  // what it has now is that of another pose
        probe.isIdle = false;
    }
}

void addFoundContacts(WorldState& world) {
    std::vector<Contact>& found = world.fastIslands.found;
    found.clear();
    for (IslandDesk& desk : world.desks) {
        found.insert(found.end(), desk.found.begin(), desk.found.end());
        desk.found.clear();
    }
    std::sort(found.begin(), found.end(), [](const Contact& a, const Contact& b) {
        return std::tie(a.shapeA, a.shapeB) < std::tie(b.shapeA, b.shapeB);
    });
    for (const Contact& contact : found) {
        if (!addContact(world, contact.shapeA, contact.shapeB)) { continue; }
        world.contacts[world.probes.back().contact] = contact;
        ++world.counters.contacts;
        ++world.counters.touching;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
