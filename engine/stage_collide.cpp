#include <algorithm>
#include <cmath>

#include "../shapes/distance.h"
#include "ghosts.h"
#include "modes.h"
#include "shape_manifold.h"
#include "slides.h"
#include "step.h"
#include "tolerances.h"
#include "travel.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts per block: enough work, some microseconds, to pay for handing it over.
constexpr std::size_t kContactGrain = 32;

/// As the stage began.
bool isAwake(const BodyGlance& body) { return !(body.motion < 0); }
bool isAwake(const WorldState& world, std::uint32_t body) { return isAwake(world.glances[body]); }

/// So that the contacts of a body need not ask it one by one.
void noteMotions(WorldState& world) {
    for (const std::uint32_t slot : world.awake) {
        world.glances[slot].motion = motionBound(world, slot, static_cast<Real>(world.lastDt));
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

namespace {

/// The manifold as `KeptManifold` says. @return false where it has to be made anew
bool keepsManifold(Contact& contact, const Transform& bInA, Real margin) {
    const KeptManifold& kept = contact.kept;
    if (!kept.isThere || contact.manifold.count != 2) { return false; }  // ghosts and passers lose their points
    const Rotation turn = bInA.rotation * inverse(kept.bInA.rotation);
    if (!(turn.c > 0) || !(std::fabs(turn.s) <= kKeepRatio)) { return false; }
    const Vec2 shift = bInA.translation - kept.bInA.translation;
    const Real farthest = kKeepRatio * contact.extent;
    std::array<Real, 2> separations;
    for (std::size_t i = 0; i < separations.size(); ++i) {
        // Of the point of B that was there; the rest of its way is the square of an angle.
        const Vec2 moved = shift + cross(turn.s, contact.manifold.points[i].point - kept.bInA.translation);
        if (!(std::fabs(moved.x) + std::fabs(moved.y) <= farthest)) { return false; }
        separations[i] = kept.separations[i] + dot(kept.normal, moved);
        if (separations[i] > margin) { return false; }
    }
    contact.manifold.points[0].separation = separations[0];
    contact.manifold.points[1].separation = separations[1];
    if (contact.manifold.isNormalOfB) { contact.manifold.normal = kept.normal + cross(turn.s, kept.normal); }
    return true;
}

void renewManifold(const WorldState& world, Contact& contact, const Transform& bInA, Real margin) {
    noteSlide(contact, bInA);
    const Manifold manifold =
        shapeManifold(world, world.shapes[contact.shapeA], world.shapes[contact.shapeB], bInA, margin, contact.memory);
    contact.kept = {
        bInA, manifold.normal, {manifold.points[0].separation, manifold.points[1].separation}, manifold.count == 2};
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

Transform relativePoseOf(const WorldState& world, const Contact& contact) {
    return relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
}

}  // namespace

void refreshManifold(const WorldState& world, Contact& contact, Real margin) {
    renewManifold(world, contact, relativePoseOf(world, contact), margin);
}

namespace {

/// `contactReach` of one side. @tparam kWatched  whether the world is: that of speculative bodies is not what was noted
template <bool kWatched>
Real reachOf(const WorldState& world, std::uint32_t body, std::uint32_t shape, Real extent) {
    // What sleeps or never moves is rare beside what moves, or cheap.
    if (kWatched || !isAwake(world, body)) { return contactReach(world, world.shapes[shape]); }
    return reachOfMotion(world.glances[body].motion, extent, false);
}

void updateSensor(const WorldState& world, Contact& contact) {
    const Distance closest = distance(world.shapes[contact.shapeA].polygon, world.shapes[contact.shapeB].polygon,
                                      relativePoseOf(world, contact));
    contact.manifold.count = closest.distance <= 0 ? 1 : 0;
    contact.manifold.normal = closest.normal;
    contact.manifold.points[0] = {.point = Real(0.5) * (closest.pointA + closest.pointB)};
}

/// A contact that may have points.
template <bool kWatched>
void updateNear(const WorldState& world, ContactProbe& probe, Contact& contact) {
    if (contact.sensor) { return updateSensor(world, contact); }
    const Transform bInA = relativePoseOf(world, contact);
    const Real margin = reachOf<kWatched>(world, contact.bodyA, contact.shapeA, contact.extentA) +
                        reachOf<kWatched>(world, contact.bodyB, contact.shapeB, contact.extentB);
    if (!keepsManifold(contact, bInA, margin)) { renewManifold(world, contact, bInA, margin); }
    contact.totalImpulse = {};
    contact.pressed = contact.pressed && contact.manifold.count > 0;
    probe.apartUntil = 0;
    if (contact.manifold.count > 0 || contact.memory.verdict != ManifoldMemory::Verdict::apart) { return; }
    rememberApart(world, probe, contact.memory.room - contact.memory.motionTo(bInA));
}

bool overlap(std::span<const Aabb> boxes, const ContactProbe& probe) {
    return overlaps(boxes[static_cast<std::size_t>(probe.proxyA)], boxes[static_cast<std::size_t>(probe.proxyB)]);
}

/// Writes only to the contact and its probe: contacts may be updated in any order.
template <bool kWatched>
void updateContact(WorldState& world, std::span<const Aabb> boxes, std::size_t index) {
    ContactProbe& probe = world.probes[index];
    const BodyGlances bodies{world.glances[probe.bodyA], world.glances[probe.bodyB]};
    if (!isAwake(bodies.a) && !isAwake(bodies.b)) {
        probe.state = ContactState::asleep;
        return;
    }
    if (!overlap(boxes, probe)) {
        probe.state = ContactState::boxesApart;
        return;
    }
    // Speculative bodies reach farther than was noted.
    const bool isTold = !kWatched && probe.isIdle;
    if (isTold && (!overlap(world.neededBoxes, probe) || bodies.movedSince(probe) < probe.apartUntil)) {
        probe.state = ContactState::apart;
        return;
    }
    probe.state = ContactState::near;
    updateNear<kWatched>(world, probe, world.contacts[index]);
}

template <bool kWatched>
void updateContacts(WorldState& world) {
    const std::span<const Aabb> boxes = world.broadphase->boxes();
    world.loops->run(world.contacts.size(), kContactGrain, [&world, boxes](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { updateContact<kWatched>(world, boxes, i); }
    });
}

void listNearContacts(WorldState& world) {
    world.nearContacts.clear();
    for (std::uint32_t i = 0; i < world.probes.size(); ++i) {
        if (world.probes[i].state == ContactState::near) { world.nearContacts.push_back(i); }
    }
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
            .bounces = contact.restitution > 0,
            .points = static_cast<std::uint8_t>(contact.manifold.count)};
}

/// Events, waking, and the list for the stages that follow, under the indices that contacts have once those are removed
/// whose boxes came apart. @return how many these are
std::uint32_t listTouching(WorldState& world) {
    world.touching.clear();
    std::uint32_t apart = 0;
    for (std::uint32_t i = 0; i < world.probes.size(); ++i) {
        ContactProbe& probe = world.probes[i];
        if (probe.state == ContactState::boxesApart) { ++apart; }
        if (probe.state == ContactState::near) {
            noticeTouching(world, world.contacts[i]);
            probe.isIdle = world.contacts[i].manifold.count == 0 && !world.contacts[i].sensor;
        }
        if (probe.isIdle || probe.state == ContactState::boxesApart) { continue; }
        const Contact& contact = world.contacts[i];
        if (!contact.isSolid()) { continue; }
        world.touching.push_back(touchingPair(contact, i - apart));
    }
    return apart;
}

void countAhead(WorldState& world) {
    for (const std::uint32_t i : world.nearContacts) {
        const Contact& contact = world.contacts[i];
        world.counters.aheadContacts += contact.isSolid() && isAhead(world, contact) ? 1 : 0;
    }
}

}  // namespace

void collideContacts(WorldState& world) {
    noteMotions(world);
    if (world.contacts.empty() && world.candidates.empty()) {
        world.touching.clear();
        if (world.joints.size() > 0 && anyAsleep(world)) { wakeAcrossJoints(world); }
        return;
    }
    for (const std::uint32_t slot : world.awake) { noteMotion(world, slot); }
    promoteCandidates(world);
    if (world.watched) {
        updateContacts<true>(world);
    } else {
        updateContacts<false>(world);
    }
    listNearContacts(world);
    dropGhosts(world, world.contacts, world.nearContacts, world.awake);
    if (world.joints.size() > 0 && anyAsleep(world)) { wakeAcrossJoints(world); }
    const std::uint32_t apart = listTouching(world);
    world.counters.manifolds += world.nearContacts.size();
    if (world.watched) { countAhead(world); }
    if (apart > 0) { removeApartContacts(world); }
    world.counters.contacts = world.contacts.size() + world.candidates.size();
    world.counters.touching = world.touching.size();
}

}  // namespace swept::inline SWEPT_PRECISION
