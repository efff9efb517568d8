#include <algorithm>
#include <vector>

#include "../contacts/pairs_of_shapes.h"
#include "../queries.h"
#include "../state/world_state.h"
#include "../world.h"

/// What touches, asked between steps. What is called back may change the world: all is listed before any is told.

namespace swept::inline SWEPT_PRECISION {
namespace {

void listPoints(const WorldState& world, const Contact& contact, std::vector<ContactView>& views) {
    if (!contact.isSolid()) { return; }
    const WorldTransform& pose = world.motions[contact.bodyA].pose;
    ContactView view;
    const Shape& a = world.shapes[contact.shapeA];
    const Shape& b = world.shapes[contact.shapeB];
    view.shapeA = world.shapes.idOf(a.head);
    view.shapeB = world.shapes.idOf(b.head);
    view.segmentA = a.segmentIndex;
    view.segmentB = b.segmentIndex;
    view.bodyA = world.bodies.idOf(contact.bodyA);
    view.bodyB = world.bodies.idOf(contact.bodyB);
    view.normal = rotate(pose.rotation, contact.manifold.normal);
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        view.point = apply(pose, contact.manifold.points[i].point);
        view.separation = contact.manifold.points[i].separation;
        view.impulse = contact.totalImpulse[i];
        views.push_back(view);
    }
}

void tellAll(const World& world, const std::vector<ContactView>& views, FunctionRef<void(const ContactView&)> visit) {
    for (const ContactView& view : views) {
        if (world.isValid(view.shapeA) && world.isValid(view.shapeB)) { visit(view); }
    }
}

/// Calls `visit` with the contacts among these pairs.
template <class Visit>
void visitContactsAt(WorldState& world, std::span<const std::uint32_t> places, const Visit& visit) {
    for (const std::uint32_t place : places) {
        const ContactProbe* const probe = probeAt(world, place);
        if (probe == nullptr) { break; }  // candidates do not touch
        visit(world.contacts[probe->contact]);
    }
}

}  // namespace

void World::visitContacts(FunctionRef<void(const ContactView&)> visit) const {
    std::vector<ContactView> views;
    for (const std::span<const ContactProbe> probes : {std::span(state_->probes), state_->parked.probes.all()}) {
        for (const ContactProbe& probe : probes) {
            if (!isGap(probe)) { listPoints(*state_, state_->contacts[probe.contact], views); }
        }
    }
    tellAll(*this, views, visit);
}

void World::visitContacts(BodyId id, FunctionRef<void(const ContactView&)> visit) const {
    WorldState& world = *state_;
    const Body* body = world.bodies.find(id);
    if (body == nullptr) { return; }
    const auto isOfBody = [slot = id.index](const ContactPair& pair) {
        return pair.bodyA == slot || pair.bodyB == slot;
    };
    std::vector<std::uint32_t> places;
    findPairsOf(world, body->shapes, isOfBody, places);
    std::vector<ContactView> views;
    visitContactsAt(world, places, [&](const Contact& contact) { listPoints(world, contact, views); });
    tellAll(*this, views, visit);
}

void World::visitOverlaps(ShapeId sensor, FunctionRef<void(ShapeId)> visit) const {
    WorldState& world = *state_;
    if (!isValid(sensor) || !world.shapes[sensor.index].def.sensor) { return; }
    const std::uint32_t head = sensor.index;
    std::vector<std::uint32_t> slots;
    listSlots(world, head, slots);
    std::vector<std::uint32_t> places;
    findPairsOfShape(world, slots, places);
    std::vector<ShapeId> others;
    visitContactsAt(world, places, [&](const Contact& contact) {
        if (contact.sensor && contact.touching && world.shapes[contact.shapeA].head == head) {
            others.push_back(world.shapes.idOf(world.shapes[contact.shapeB].head));
        }
    });
    // A chain has one id, however many of its segments overlap.
    std::sort(others.begin(), others.end(), [](ShapeId a, ShapeId b) { return a.index < b.index; });
    others.erase(std::unique(others.begin(), others.end()), others.end());
    for (const ShapeId other : others) {
        if (isValid(other)) { visit(other); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
