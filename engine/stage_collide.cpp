#include <algorithm>
#include <array>
#include <cmath>

#include "../shapes/distance.h"
#include "beside.h"
#include "chain_passage.h"
#include "contact_batch.h"
#include "contact_fetch.h"
#include "contact_manifold.h"
#include "ghosts.h"
#include "modes.h"
#include "slides.h"
#include "step.h"
#include "tolerances.h"
#include "travel.h"
#include "waking.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts per block: enough work, some microseconds, to pay for handing it over.
constexpr std::size_t kContactGrain = 32;
/// Bodies, likewise.
constexpr std::size_t kNoteGrain = 16;

bool isAwake(const WorldState& world, std::uint32_t body) { return world.glances[body].isAwake(); }

/// So that the contacts of a body need not ask it one by one. @param haveContacts  else a bound of its motion is all
/// that is asked
void noteSome(WorldState& world, std::span<const std::uint32_t> awake, bool haveContacts) {
    for (std::size_t i = 0; i < awake.size(); ++i) {
        fetchAhead(world, awake.subspan(i));
        const std::uint32_t slot = awake[i];
        world.glances[slot].motion = motionBound(world, slot, static_cast<Real>(world.lastDt));
        if (haveContacts) { noteMotion(world, slot); }
    }
}

/// Of all that is awake, while one worker takes up the new pairs. What these release is awake then, too.
void noteMotions(WorldState& world, bool haveContacts) {
    const std::span<const std::uint32_t> awake = world.awake;
    const auto note = [&world, awake, haveContacts](std::size_t begin, std::size_t end) {
        noteSome(world, awake.subspan(begin, end - begin), haveContacts);
    };
    const std::size_t before = awake.size();
    runBeside(
        *world.loops, [&world] { addPairs(world); }, before, kNoteGrain, note);
    releaseMet(world);
    noteSome(world, std::span(world.awake).subspan(before), haveContacts);
}

/// `contactReach` of one side. @tparam kWatched  whether the world is: that of speculative bodies is not what was noted
template <bool kWatched>
Real reachOf(const WorldState& world, std::uint32_t body, std::uint32_t shape, Real extent) {
    // What sleeps or never moves is rare beside what moves, or cheap.
    if (!kWatched && isAwake(world, body)) { return reachOfMotion(world.glances[body].motion, extent, false); }
    if (world.bodies[body].def.type == BodyType::fixed) { return 0; }
    return contactReach(world, world.shapes[shape]);
}

void updateSensor(const WorldState& world, Contact& contact) {
    const Distance closest = distance(world.shapes[contact.shapeA].polygon, world.shapes[contact.shapeB].polygon,
                                      relativePoseOf(world, contact));
    contact.manifold.count = closest.distance <= 0 ? 1 : 0;
    contact.manifold.normal = closest.normal;
    contact.manifold.points[0] = {.point = Real(0.5) * (closest.pointA + closest.pointB)};
}

/// Which points are asked for.
enum class NearestPoints : std::uint8_t {
    unlessPassing,  ///< those of bodies that pass each other are not
    all
};

/// What touched or pressed has points as long as it may, so that its end is told where it was.
bool mayPass(const ContactProbe& probe, const Contact& contact) {
    return (int{probe.isPlain} & int{!contact.touching} & int{!contact.pressed}) != 0;
}

/// Of a contact that may have points. @tparam kWatched  as above
template <bool kWatched>
ManifoldReach reachOf(const WorldState& world, const ContactProbe& probe, const Contact& contact, NearestPoints asked) {
    const Real margin = reachOf<kWatched>(world, contact.bodyA, contact.shapeA, contact.extentA) +
                        reachOf<kWatched>(world, contact.bodyB, contact.shapeB, contact.extentB);
    if (kWatched || asked == NearestPoints::all) { return {margin, margin}; }
    const BodyGlances bodies{world.glances[contact.bodyA], world.glances[contact.bodyB]};
    // One branch: none of these foretells the other.
    if ((int{mayPass(probe, contact)} & int{bodies.canPass()}) == 0) { return {margin, margin}; }
    return {margin, bodies.passesBeyond(static_cast<Real>(world.lastDt))};
}

bool isTouching(const Contact& contact) {
    if (contact.manifold.count == 0) { return false; }
    if (contact.sensor) { return true; }
    const Real limit = (contact.touching ? kEndRatio : kBeginRatio) * contact.extent;
    return deepestSeparation(contact.manifold) <= limit;
}

bool isDeep(const Contact& contact) { return deepestSeparation(contact.manifold) < -kShallowRatio * contact.extent; }

bool isOpen(const Contact& contact) { return deepestSeparation(contact.manifold) > kEndRatio * contact.extent; }

/// A contact that may have points has its manifold.
[[gnu::always_inline]] inline void finishNear(const WorldState& world, ContactProbe& probe, Contact& contact,
                                              const Transform& bInA) {
    contact.totalImpulse = {};
    contact.pressed = (int{contact.pressed} & int{contact.manifold.count > 0}) != 0;
    probe.apartUntil = 0;
    if (contact.manifold.count == 0 && contact.memory.verdict == ManifoldMemory::Verdict::apart) {
        rememberApart(world, probe, contact.memory.room - contact.memory.motionTo(bInA));
    }
    const Real deepest = deepestSeparation(contact.manifold);
    // Looked up, not branched on, like the rest: nothing foretells whether it touched, or has points.
    static constexpr std::array<Real, 2> kRatios{kBeginRatio, kEndRatio};
    const Real limit = kRatios[contact.touching ? 1 : 0] * contact.extent;
    probe.points = static_cast<std::uint8_t>(contact.manifold.count);
    probe.turns = (int{contact.manifold.count > 0} & int{deepest <= limit}) != int{contact.touching};
    probe.isOpen = deepest > kEndRatio * contact.extent;
    probe.isDeep = !probe.isPlain && deepest < -kShallowRatio * contact.extent;
}

/// Gives contacts that may have points their manifolds, in any order: writes only to them, their probes and their
/// slides.
template <bool kWatched>
class NearUpdate {
public:
    NearUpdate(WorldState& world, NearestPoints asked)
        : world_(world),
          asked_(asked),
          areAllUp_(areAllUp(world)),
          slides_(world.slides),
          batches_(world, Finish{this}) {}

    void add(ContactProbe& probe, Contact& contact) {
        if (contact.sensor) {
            updateSensor(world_, contact);
            probe.isUnseen = false;
            probe.points = static_cast<std::uint8_t>(contact.manifold.count);
            probe.turns = isTouching(contact) != contact.touching;
            return;
        }
        const Transform bInA = relativePoseOf(world_, contact);
        const ManifoldReach reach = reachOf<kWatched>(world_, probe, contact, asked_);
        probe.areUp = areAllUp_ || ((isAwake(world_, contact.bodyA) || !probe.dynamicA) &&
                                    (isAwake(world_, contact.bodyB) || !probe.dynamicB));
        probe.wasKept = mayKeepManifold(contact, bInA) && keepsManifold(contact, bInA, reach);
        if (!probe.wasKept) {
            if (!probe.isPlain) { slides_[probe.contact] = slideOf(contact, bInA); }
            return batches_.add(&probe, contact, bInA, reach);
        }
        settle(probe, contact, bInA);
    }
    /// What is left in batches.
    void finish() { batches_.finish(); }

private:
    struct Finish {
        NearUpdate* update;
        void operator()(ContactProbe* probe, Contact& contact, const Transform& bInA) const {
            update->settle(*probe, contact, bInA);
        }
    };
    [[gnu::always_inline]] void settle(ContactProbe& probe, Contact& contact, const Transform& bInA) const {
        finishNear(world_, probe, contact, bInA);
        notePassing(probe, contact);
    }
    /// What has no points since its bodies pass each other may still be hemmed in (hemmed_pairs.h).
    void notePassing(ContactProbe& probe, const Contact& contact) const {
        if (kWatched || probe.points > 0 || asked_ == NearestPoints::all || !mayPass(probe, contact)) { return; }
        const BodyGlances bodies{world_.glances[probe.bodyA], world_.glances[probe.bodyB]};
        if (!bodies.mayBeHemmed(probe)) { return; }
        probe.state = ContactState::passing;
        probe.isIdle = true;
    }

    const WorldState& world_;
    NearestPoints asked_;
    bool areAllUp_;  ///< then no body need be asked
    std::span<Slide> slides_;
    ContactBatches<Finish> batches_;
};

/// Writes only to the contacts and their probes: they may be updated in any order.
template <bool kWatched>
void updateContacts(WorldState& world, std::span<const std::uint32_t> near, NearestPoints asked) {
    world.slides.resize(world.contacts.size());
    world.loops->run(near.size(), kContactGrain, [&world, near, asked](std::size_t begin, std::size_t end, int) {
        NearUpdate<kWatched> update(world, asked);
        const std::span<ContactProbe> probes = world.probes;
        const std::span<Contact> contacts = world.contacts;
        for (std::size_t i = begin; i < end; ++i) {
            fetchAhead(world, probes, contacts, near.subspan(i, end - i));
            ContactProbe& probe = probes[near[i]];
            update.add(probe, contacts[probe.contact]);
        }
        update.finish();
    });
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

TouchingPair touchingPair(const Contact& contact, std::uint32_t place) {
    const TouchTraits traits{.points = static_cast<std::uint8_t>(contact.manifold.count),
                             .dynamicA = contact.dynamicA,
                             .dynamicB = contact.dynamicB,
                             .bounces = contact.restitution > 0,
                             .isBelt = contact.isBelt,
                             .resistsRolling = contact.resistsRolling,
                             .isOpen = isOpen(contact),
                             .isDeep = !(contact.dynamicA && contact.dynamicB) && isDeep(contact)};
    return {traits, place, contact.bodyA, contact.bodyB};
}

/// Of what `isTold`.
TouchingPair touchingPair(const ContactProbe& probe) { return {probe, probe.contact, probe.bodyA, probe.bodyB}; }

/// Few contacts lose their points to others of the same body: their probes tell what they had before.
void distrustGhosts(WorldState& world) {
    for (const std::uint32_t i : world.lists.near) {
        ContactProbe& probe = world.probes[i];
        if (!probe.isPlain && probe.points > 0 && !world.contacts[probe.contact].isSolid()) { probe.areUp = false; }
    }
}

/// Whether the probe of a contact tells all: mostly.
bool isTold(const ContactProbe& probe) {
    return (int{probe.state == ContactState::near} & int{probe.areUp} & int{!probe.turns}) != 0;
}

/// @pre `isTold`
[[gnu::always_inline]] inline void listTold(WorldState& world, ContactProbe& probe) {
    probe.isIdle = probe.points == 0;
    if (!probe.isIdle) { world.touching.push_back(touchingPair(probe)); }
}

/// Another contact whose manifold is new, or which sleeps with points.
void listOther(WorldState& world, ContactProbe& probe) {
    if (probe.state == ContactState::near) {
        noticeTouching(world, world.contacts[probe.contact]);
        probe.isIdle = world.contacts[probe.contact].manifold.count == 0 && !world.contacts[probe.contact].sensor;
    }
    const Contact& contact = world.contacts[probe.contact];
    if (contact.isSolid()) { world.touching.push_back(touchingPair(contact, probe.contact)); }
}

/// Of what is near: probes whose touching begins or ends.
void findTurning(WorldState& world) {
    RawVector<std::uint32_t>& turning = world.lists.turning;
    const std::span<const ContactProbe> probes = world.probes;
    turning.resize(world.lists.near.size());
    std::size_t count = 0;
    for (const std::uint32_t place : world.lists.near) {  // no branch: nothing foretells which
        turning[count] = place;
        count += probes[place].turns ? 1 : 0;
    }
    turning.resize(count);
}

/// Events, waking, and the lists for the stages that follow.
void listTouching(WorldState& world) {
    findTurning(world);
    const std::span<ContactProbe> probes = world.probes;
    const std::span<const std::uint32_t> turning = world.lists.turning;
    std::size_t told = 0;
    for (const std::uint32_t i : world.lists.noted) {
        ContactProbe& probe = probes[i];
        if (isTold(probe)) {
            listTold(world, probe);
            continue;
        }
        if (told < turning.size() && turning[told] == i) { fetchForEvents(world, turning.subspan(told++)); }
        if (probe.state == ContactState::near || probe.state == ContactState::asleep) {
            listOther(world, probe);
        } else if (probe.state == ContactState::passing) {
            world.lists.passing.push_back(i);
        }
    }
}

void countAhead(WorldState& world) {
    for (const std::uint32_t i : world.lists.near) {
        const Contact& contact = world.contacts[world.probes[i].contact];
        world.counters.aheadContacts += contact.isSolid() && isAhead(world, contact) ? 1 : 0;
    }
}

bool hasContacts(const WorldState& world) { return !world.probes.empty() || !world.candidates.empty(); }

void countContacts(WorldState& world) {
    world.counters.contacts =
        world.probes.size() + world.candidates.size() + world.parked.probes.size() + world.parked.candidates.size();
    world.counters.touching = world.touching.size() + world.parked.touching;
}

}  // namespace

void listUnparked(WorldState& world) {
    const std::size_t count = unparkContacts(world);
    for (const ContactProbe& probe : std::span(world.probes).last(count)) {
        const Contact& contact = world.contacts[probe.contact];
        if (contact.isSolid()) { world.touching.push_back(touchingPair(contact, probe.contact)); }
    }
}

void collideHemmed(WorldState& world, std::span<const std::uint32_t> probes) {
    updateContacts<false>(world, probes, NearestPoints::all);
    world.counters.manifolds += probes.size();
}

void listHemmed(WorldState& world, std::span<const std::uint32_t> probes) {
    const std::size_t before = world.touching.size();
    for (const std::uint32_t place : probes) {
        ContactProbe& probe = world.probes[place];
        probe.state = ContactState::near;
        isTold(probe) ? listTold(world, probe) : listOther(world, probe);
    }
    world.counters.touching += world.touching.size() - before;
}

void collideContacts(WorldState& world) {
    const ParkedContacts& parked = world.parked;
    const bool areAnyParked = parked.probes.size() > 0 || parked.candidates.size() > 0;
    noteMotions(world, areAnyParked || hasContacts(world) || !world.newPairs.empty());
    unparkContacts(world);
    parkContacts(world);
    closeGaps(world);
    world.touching.clear();
    if (!hasContacts(world)) {
        world.lists.clear();
        world.chainPassers.clear();
        return;
    }
    promoteCandidates(world);
    listContacts(world);
    if (world.watched) {
        updateContacts<true>(world, world.lists.near, NearestPoints::unlessPassing);
    } else {
        updateContacts<false>(world, world.lists.near, NearestPoints::unlessPassing);
    }
    world.counters.manifolds += world.lists.near.size();
    letThrough(world);  // here, since others forget where the last step began while contacts are noticed
}

void noticeContacts(WorldState& world) {
    const bool haveContacts = hasContacts(world);
    const bool anyGhost = haveContacts && dropGhosts(world, world.contacts, world.slides, world.lists.ground,
                                                     world.awake, world.nextGroundContact);
    if (anyGhost || !world.chainPassers.empty()) { distrustGhosts(world); }
    const bool mayJointsWake = !world.jointChains.areCurrent || world.jointChains.tieSleepers;
    if (mayJointsWake && world.joints.size() > 0 && anyAsleep(world)) { wakeAcrossJoints(world, 0); }
    const std::size_t before = world.awake.size();
    if (haveContacts) {
        if (world.watched) { countAhead(world); }
        listTouching(world);
        removeApartContacts(world);
    }
    wakeOnward(world, before);
    if (!world.parked.woken.empty()) { listUnparked(world); }
    countContacts(world);
}

}  // namespace swept::inline SWEPT_PRECISION
