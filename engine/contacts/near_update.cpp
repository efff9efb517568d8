#include "near_update.h"

#include <array>

#include "../../shapes/compiler.h"
#include "../../shapes/distance.h"
#include "../bodies/travel.h"
#include "contact_batch.h"
#include "contact_fetch.h"
#include "contact_manifold.h"
#include "contact_tests.h"
#include "slides.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts per block: enough work, some microseconds, to pay for handing it over.
constexpr std::size_t kContactGrain = 32;

/// `contactReach` of one side. @tparam kWatched  whether the world is: that of speculative bodies is not what was noted
template <bool kWatched>
Real reachOf(const WorldState& world, std::uint32_t body, std::uint32_t shape, Real extent) {
    // What sleeps or never moves is rare beside what moves, or cheap.
    if (!kWatched && isUp(world, body)) { return reachOfMotion(reachMotion(world.glances[body]), extent, false); }
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

/// Whether what is so far apart may meet in this step, along the normal of now: cheaper here, where all is at hand.
bool mayMeet(const WorldState& world, const Contact& contact, Real gap) {
    const BodyGlances bodies{world.glances[contact.bodyA], world.glances[contact.bodyB]};
    if (!contact.dynamicA || !contact.dynamicB || !bodies.a.isAwake() || !bodies.b.isAwake()) { return true; }
    const auto dt = static_cast<Real>(world.lastDt);
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    return bodies.closingSpeed(normal, dt) * dt > gap;
}

/// A contact that may have points has its manifold.
SWEPT_FORCE_INLINE void finishNear(const WorldState& world, ContactProbe& probe, Contact& contact,
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
    // All of it is known before any is written: these share a byte, and whoever reads what was just written waits.
    const bool turns = (int{contact.manifold.count > 0} & int{deepest <= limit}) != int{contact.touching};
    const bool isOpen = deepest > kEndRatio * contact.extent;
    const bool isDeep = (int{!probe.isPlain} & int{deepest < -kShallowRatio * contact.extent}) != 0;
    const bool mayMeetNow = deepest > limit && mayMeet(world, contact, deepest);
    probe.points = static_cast<std::uint8_t>(contact.manifold.count);
    probe.turns = turns;
    probe.isOpen = isOpen;
    probe.mayMeet = mayMeetNow;
    probe.isDeep = isDeep;
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
        probe.areUp = areAllUp_ || ((isUp(world_, contact.bodyA) || !probe.dynamicA) &&
                                    (isUp(world_, contact.bodyB) || !probe.dynamicB));
        probe.wasKept = mayKeepManifold(contact, bInA) && keepsManifold(contact, bInA, reach);
        if (!probe.wasKept) {
            if (!probe.isPlain) { noteSlide(slides_[probe.contact], contact, bInA); }
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
    SWEPT_FORCE_INLINE void settle(ContactProbe& probe, Contact& contact, const Transform& bInA) const {
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

}  // namespace

void updateNear(WorldState& world) {
    if (world.watched) {
        updateContacts<true>(world, world.lists.near, NearestPoints::unlessPassing);
    } else {
        updateContacts<false>(world, world.lists.near, NearestPoints::unlessPassing);
    }
    world.counters.manifolds += world.lists.near.size();
}

void collideHemmed(WorldState& world, std::span<const std::uint32_t> probes) {
    updateContacts<false>(world, probes, NearestPoints::all);
    world.counters.manifolds += probes.size();
}

}  // namespace swept::inline SWEPT_PRECISION
