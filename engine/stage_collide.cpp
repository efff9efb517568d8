#include <algorithm>

#include "../shapes/distance.h"
#include "ghosts.h"
#include "modes.h"
#include "shape_manifold.h"
#include "step.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts per block: enough work, some microseconds, to pay for handing it over.
constexpr std::size_t kContactGrain = 32;

bool isAwake(const WorldState& world, std::uint32_t body) { return !(world.motionBounds[body] < 0); }

bool isMoving(const WorldState& world, const Contact& contact) {
    return isAwake(world, contact.bodyA) || isAwake(world, contact.bodyB);
}

/// So that the contacts of a body need not ask it one by one.
void noteMotionBounds(WorldState& world) {
    world.motionBounds.assign(world.bodies.slotCount(), -1);
    for (const std::uint32_t slot : world.awake) {
        world.motionBounds[slot] = motionBound(world, slot, static_cast<Real>(world.lastDt));
    }
}

int pointWithId(const Manifold& manifold, FeatureId id) {
    for (int i = 0; i < manifold.count; ++i) {
        if (manifold.points[static_cast<std::size_t>(i)].id == id) { return i; }
    }
    return -1;
}

/// Of the same features, in the same order.
bool hasSamePoints(const Manifold& a, const Manifold& b) {
    if (a.count != b.count) { return false; }
    if (a.count == 2) {
        return a.points[0].id == b.points[0].id && a.points[1].id == b.points[1].id && a.points[0].id != a.points[1].id;
    }
    return a.count == 0 || a.points[0].id == b.points[0].id;
}

/// What there was of a contact before its manifold was renewed.
struct OldPoints {
    Manifold manifold;
    std::array<Real, 2> normalImpulse;
    std::array<Real, 2> tangentImpulse;
    Real extent;
};

/// The old point that a new one continues: of the same features, else the nearest within a part of the extent (clipping
/// may name a point after either of two vertices that stand at the same place). One that another new point has by name,
/// or that lies nearer to the other one, is not free: two points must not take over the same impulse.
int predecessorOf(const Manifold& now, std::size_t index, const OldPoints& before) {
    const ManifoldPoint& point = now.points[index];
    const int same = pointWithId(before.manifold, point.id);
    if (same >= 0) { return same; }
    int nearest = -1;
    Real least = square(kSamePlaceRatio * before.extent);
    for (int i = 0; i < before.manifold.count; ++i) {
        const ManifoldPoint& old = before.manifold.points[static_cast<std::size_t>(i)];
        const Real away = lengthSquared(old.point - point.point);
        if (!(away < least) || pointWithId(now, old.id) >= 0) { continue; }
        if (now.count > 1) {
            const Real fromOther = lengthSquared(old.point - now.points[1 - index].point);
            if (fromOther < away || (fromOther == away && index > 0)) { continue; }
        }
        nearest = i;
        least = away;
    }
    return nearest;
}

void carryImpulses(const OldPoints& before, Contact& now) {
    now.normalImpulse = {};
    now.tangentImpulse = {};
    for (std::size_t i = 0; i < static_cast<std::size_t>(now.manifold.count); ++i) {
        const int old = predecessorOf(now.manifold, i, before);
        if (old < 0) { continue; }
        now.normalImpulse[i] = before.normalImpulse[static_cast<std::size_t>(old)];
        now.tangentImpulse[i] = before.tangentImpulse[static_cast<std::size_t>(old)];
    }
}

}  // namespace

void refreshManifold(const WorldState& world, Contact& contact, Real margin) {
    const Transform bInA = relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
    const Manifold manifold =
        shapeManifold(world, world.shapes[contact.shapeA], world.shapes[contact.shapeB], bInA, margin, contact.memory);
    if (hasSamePoints(contact.manifold, manifold)) {  // as nearly always: impulses stay where they are
        contact.manifold = manifold;
        for (auto i = static_cast<std::size_t>(manifold.count); i < contact.normalImpulse.size(); ++i) {
            contact.normalImpulse[i] = contact.tangentImpulse[i] = 0;
        }
        return;
    }
    const OldPoints before{contact.manifold, contact.normalImpulse, contact.tangentImpulse, contact.extent};
    contact.manifold = manifold;
    carryImpulses(before, contact);
}

namespace {

/// `contactReach` of one side. @tparam kWatched  whether the world is: that of speculative bodies is not what was noted
template <bool kWatched>
Real reachOf(const WorldState& world, std::uint32_t body, std::uint32_t shape, Real extent) {
    // What sleeps or never moves is rare beside what moves, or cheap.
    if (kWatched || !isAwake(world, body)) { return contactReach(world, world.shapes[shape]); }
    return reachOfMotion(world.motionBounds[body], extent, false);
}

/// Writes only to the contact: contacts may be updated in any order.
template <bool kWatched>
void updateContact(const WorldState& world, Contact& contact) {
    contact.updated = isMoving(world, contact);
    if (!contact.updated) { return; }
    contact.apart = !overlaps(world.broadphase->box(contact.proxyA), world.broadphase->box(contact.proxyB));
    if (contact.apart) { return; }
    if (contact.sensor) {
        const Shape& a = world.shapes[contact.shapeA];
        const Shape& b = world.shapes[contact.shapeB];
        const Transform bInA =
            relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
        const Distance closest = distance(a.polygon, b.polygon, bInA);
        contact.manifold.count = closest.distance <= 0 ? 1 : 0;
        contact.manifold.normal = closest.normal;
        contact.manifold.points[0] = {.point = Real(0.5) * (closest.pointA + closest.pointB)};
        return;
    }
    refreshManifold(world, contact,
                    reachOf<kWatched>(world, contact.bodyA, contact.shapeA, contact.extentA) +
                        reachOf<kWatched>(world, contact.bodyB, contact.shapeB, contact.extentB));
    contact.totalImpulse = {};
    contact.pressed = contact.pressed && contact.manifold.count > 0;
}

template <bool kWatched>
void updateContacts(WorldState& world) {
    world.loops->run(world.contacts.size(), kContactGrain, [&world](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { updateContact<kWatched>(world, world.contacts[i]); }
    });
}

bool isTouching(const Contact& contact) {
    if (contact.manifold.count == 0) { return false; }
    if (contact.sensor) { return true; }
    const Real limit = (contact.touching ? kEndRatio : kBeginRatio) * contact.extent;
    return deepestSeparation(contact.manifold) <= limit;
}

ContactEvent eventOf(const WorldState& world, const Contact& contact, bool begins) {
    ContactEvent event;
    if (contact.sensor) {
        event.type = begins ? ContactEventType::sensorBegin : ContactEventType::sensorEnd;
    } else {
        event.type = begins ? ContactEventType::begin : ContactEventType::end;
    }
    event.shapeA = world.shapes.idOf(world.shapes[contact.shapeA].head);
    event.shapeB = world.shapes.idOf(world.shapes[contact.shapeB].head);
    event.bodyA = world.bodies.idOf(contact.bodyA);
    event.bodyB = world.bodies.idOf(contact.bodyB);
    if (contact.sensor || contact.manifold.count > 0) {
        const WorldTransform& pose = world.motions[contact.bodyA].pose;
        event.point = apply(pose, contact.manifold.points[0].point);
        event.normal = rotate(pose.rotation, contact.manifold.normal);
    }
    return event;
}

/// Awake and able to push: a kinematic body at rest lets others sleep on it.
bool disturbs(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const bool moves = motion.velocity != Vec2{} || motion.angularVelocity != 0;
    return body.awake && (body.isDynamic() || moves);
}

/// Between parallel updates, in order of the contacts: events, and waking of what an awake body touches.
void noticeTouching(WorldState& world, Contact& contact) {
    if (!contact.updated || contact.apart) { return; }
    ++world.counters.manifolds;
    const bool touching = isTouching(contact);
    if (touching != contact.touching) {
        world.contactEvents.push_back(eventOf(world, contact, touching));
        contact.touching = touching;
    }
    if (!contact.isSolid()) { return; }
    const bool sleepsA = contact.dynamicA && !isAwake(world, contact.bodyA);
    const bool sleepsB = contact.dynamicB && !isAwake(world, contact.bodyB);
    if (!sleepsA && !sleepsB) { return; }
    if (disturbs(world, contact.bodyA) && world.bodies[contact.bodyB].isDynamic()) { wake(world, contact.bodyB); }
    if (disturbs(world, contact.bodyB) && world.bodies[contact.bodyA].isDynamic()) { wake(world, contact.bodyA); }
}

/// A joint pulls: what is awake and moves wakes what hangs on it.
void wakeAcrossJoints(WorldState& world) {
    for (std::size_t i = 0; i < world.awake.size(); ++i) {  // grows as it goes
        const std::uint32_t slot = world.awake[i];
        if (!disturbs(world, slot)) { continue; }
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const Joint& joint = world.joints[index];
            if (!joint.holds()) { continue; }
            for (const std::uint32_t other : joint.allBodies()) { wake(world, other); }
        }
    }
}

TouchingPair touchingPair(const Contact& contact, std::uint32_t place) {
    return {.contact = place,
            .bodyA = contact.bodyA,
            .bodyB = contact.bodyB,
            .dynamicA = contact.dynamicA,
            .dynamicB = contact.dynamicB,
            .points = static_cast<std::uint8_t>(contact.manifold.count),
            .begins = !(contact.normalImpulse[0] > 0) && !(contact.normalImpulse[1] > 0)};
}

void countAhead(WorldState& world) {
    for (const Contact& contact : world.contacts) {
        const bool counts = contact.updated && !contact.apart && contact.isSolid();
        world.counters.aheadContacts += counts && isAhead(world, contact) ? 1 : 0;
    }
}

}  // namespace

void collideContacts(WorldState& world) {
    noteMotionBounds(world);
    if (world.contacts.empty()) {
        world.touching.clear();
        if (world.joints.size() > 0) { wakeAcrossJoints(world); }
        return;
    }
    if (world.watched) {
        updateContacts<true>(world);
    } else {
        updateContacts<false>(world);
    }
    dropGhosts(world, world.contacts, world.awake);
    if (world.joints.size() > 0) { wakeAcrossJoints(world); }
    world.touching.clear();
    std::uint32_t apart = 0;
    for (std::uint32_t i = 0; i < world.contacts.size(); ++i) {
        Contact& contact = world.contacts[i];
        noticeTouching(world, contact);
        if (contact.updated && contact.apart) {
            ++apart;
        } else if (contact.isSolid()) {
            world.touching.push_back(touchingPair(contact, i - apart));  // its place once those are removed
        }
    }
    if (world.watched) { countAhead(world); }
    if (apart > 0) {
        removeContacts(world, [](const Contact& contact) { return contact.updated && contact.apart; });
    }
    world.counters.contacts = world.contacts.size();
    world.counters.touching = world.touching.size();
}

}  // namespace swept::inline SWEPT_PRECISION
