#include "noticing.h"

#include "../bodies/awake.h"
#include "../state/tolerances.h"
#include "contact_tests.h"
#include "parked_contacts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void tellTurn(WorldState& world, const Contact& contact, bool begins) {
    ContactEvent& event = world.contactEvents.emplace_back();
    if (contact.sensor) {
        event.type = begins ? ContactEventType::sensorBegin : ContactEventType::sensorEnd;
    } else {
        event.type = begins ? ContactEventType::begin : ContactEventType::end;
    }
    const Shape& a = world.shapes[contact.shapeA];
    const Shape& b = world.shapes[contact.shapeB];
    event.shapeA = world.shapes.idOf(a.head);
    event.shapeB = world.shapes.idOf(b.head);
    event.segmentA = a.segmentIndex;
    event.segmentB = b.segmentIndex;
    event.bodyA = world.bodies.idOf(contact.bodyA);
    event.bodyB = world.bodies.idOf(contact.bodyB);
    if (contact.sensor || contact.manifold.count > 0) {
        const WorldTransform& pose = world.motions[contact.bodyA].pose;
        event.point = apply(pose, contact.manifold.points[0].point);
        event.normal = rotate(pose.rotation, contact.manifold.normal);
    }
}

bool isDeep(const Contact& contact) { return deepestSeparation(contact.manifold) < -kShallowRatio * contact.extent; }

bool isOpen(const Contact& contact) { return deepestSeparation(contact.manifold) > kEndRatio * contact.extent; }

/// In order of the contacts: events, and waking of what an awake body touches.
void noticeTouching(WorldState& world, Contact& contact) {
    const bool touching = isTouching(contact);
    if (touching != contact.touching) {
        tellTurn(world, contact, touching);
        contact.touching = touching;
    }
    if (!contact.isSolid()) { return; }
    const bool sleepsA = contact.dynamicA && !isUp(world, contact.bodyA);
    const bool sleepsB = contact.dynamicB && !isUp(world, contact.bodyB);
    if (!sleepsA && !sleepsB) { return; }
    if (disturbs(world, contact.bodyA) && world.bodies[contact.bodyB].isDynamic()) { wake(world, contact.bodyB); }
    if (disturbs(world, contact.bodyB) && world.bodies[contact.bodyA].isDynamic()) { wake(world, contact.bodyA); }
}

}  // namespace

TouchingPair touchingPair(const Contact& contact, std::uint32_t place) {
    const TouchTraits traits{.points = static_cast<std::uint8_t>(contact.manifold.count),
                             .dynamicA = contact.dynamicA,
                             .dynamicB = contact.dynamicB,
                             .bounces = contact.restitution > 0,
                             .isBelt = contact.isBelt,
                             .resistsRolling = contact.resistsRolling,
                             .isOpen = isOpen(contact),
                             .mayMeet = !contact.touching,
                             .isDeep = !(contact.dynamicA && contact.dynamicB) && isDeep(contact)};
    return {traits, place, contact.bodyA, contact.bodyB};
}

bool noticeOther(WorldState& world, ContactProbe& probe) {
    Contact& contact = world.contacts[probe.contact];
    if (probe.state == ContactState::near) {
        noticeTouching(world, contact);
        probe.isIdle = contact.manifold.count == 0 && !contact.sensor;
        probe.isUnseen = false;
    }
    return contact.isSolid();
}

void listUnparked(WorldState& world) {
    const std::size_t count = unparkContacts(world);
    for (const ContactProbe& probe : std::span(world.probes).last(count)) {
        const Contact& contact = world.contacts[probe.contact];
        if (contact.isSolid()) { world.touching.push_back(touchingPair(contact, probe.contact)); }
    }
}

void listHemmed(WorldState& world, std::span<const std::uint32_t> probes) {
    const std::size_t before = world.touching.size();
    for (const std::uint32_t place : probes) {
        ContactProbe& probe = world.probes[place];
        probe.state = ContactState::near;
        if (isTold(probe)) {
            probe.isIdle = probe.points == 0;
            if (!probe.isIdle) { world.touching.push_back(touchingPair(probe)); }
        } else if (noticeOther(world, probe)) {
            world.touching.push_back(touchingPair(world.contacts[probe.contact], probe.contact));
        }
    }
    world.counters.touching += world.touching.size() - before;
}

}  // namespace swept::inline SWEPT_PRECISION
