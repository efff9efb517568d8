#include "note_touching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "../../shapes/branchless.h"
#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../bodies/travel.h"
#include "../contacts/hemmed_pairs.h"
#include "../contacts/near_miss.h"
#include "../state/tolerances.h"
#include "curve_ahead.h"
#include "hard_pull.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A bouncing body flies from impact to impact on a parabola, however slow it is: what comes down from the separation
/// that there is now is faster than what does not bounce. A body that is carried is moved by the solver, however fast
/// it slides, until it strikes something, or its way curves: the solver shares such a blow among the contacts less
/// well, and may throw the body up.
TouchFindings footingOf(const WorldState& world, std::uint32_t slot, std::uint32_t otherSlot, const Contact& contact,
                        Real dt) {
    TouchFindings footing;
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const BodyMotion& other = world.motions[otherSlot];
    const Vec2 fromA = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const Vec2 normal = contact.bodyB == slot ? fromA : -fromA;
    const Real pull = -dot(accelerationOf(world, body), normal);
    const bool carries = isCarried(world, body, pull, dt);
    const Real threshold = bounceThreshold(world, body, dt);
    const Real slop = kTargetRatio * contact.extent;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const DVec2 point = apply(world.motions[contact.bodyA].pose, contact.manifold.points[i].point);
        const Vec2 velocity = motion.velocity + cross(motion.angularVelocity, toReal(point - motion.center)) -
                              other.velocity - cross(other.angularVelocity, toReal(point - other.center));
        const Real approach = -dot(velocity, normal);
        const Real gap = std::max(contact.manifold.points[i].separation, Real(0));
        const bool returns = pull > 0 || approach * dt > gap;
        // Within the slop, points take part in the impacts of others: what hovers there does not bounce on them.
        const Real fall = std::max(gap - slop, Real(0));
        const bool isSlow = square(approach) + 2 * std::max(pull, Real(0)) * fall <= square(threshold);
        footing.bounces = footing.bounces || (contact.restitution > 0 && returns && !isSlow);
        footing.strikes = footing.strikes || (approach * dt > gap && !isSlow);
        footing.rests = footing.rests || (carries && isSlow && gap <= kEndRatio * contact.extent);
    }
    footing.strikes = footing.strikes || (footing.rests && slot == contact.bodyB && meetsCurve(world, contact, dt));
    return footing;
}

/// Fastest that the bodies of a contact close in on each other within the step, m/s.
Real closingSpeed(const WorldState& world, const Contact& contact, Vec2 normal, Real dt) {
    const BodyGlances bodies{world.glances[contact.bodyA], world.glances[contact.bodyB]};
    if (bodies.a.isAwake() && bodies.b.isAwake()) { return bodies.closingSpeed(normal, dt); }
    // Likewise, of what woke since, or sleeps.
    const Body& a = world.bodies[contact.bodyA];
    const Body& b = world.bodies[contact.bodyB];
    const BodyMotion& motionA = world.motions[contact.bodyA];
    const BodyMotion& motionB = world.motions[contact.bodyB];
    const Vec2 pull = accelerationOf(world, b) - accelerationOf(world, a);
    const Real turning = std::fabs(motionA.angularVelocity) * a.radius + std::fabs(motionB.angularVelocity) * b.radius;
    return turning - dot(motionB.velocity - motionA.velocity, normal) + dt * length(pull);
}

/// Whether bodies that are near each other will not meet in this step, whatever the others do to them that they have
/// met already. If both are dynamic, and one of them is fast, they do not hold each other.
/// @pre they do not touch
bool passEachOther(const WorldState& world, const Contact& contact, Real dt) {
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    return closingSpeed(world, contact, normal, dt) * dt < deepestSeparation(contact.manifold);
}

/// What of a pair only its contact tells. Mostly nothing, and then it is not looked at.
bool asksForContact(const TouchingPair& pair, BodyTraits a, BodyTraits b) {
    const std::uint32_t isOneFast = ((a | b) / kIsFast) & 1;
    const std::uint32_t mayStrike = (std::uint32_t{pair.bounces} | isOneFast | std::uint32_t{pair.isDeep});
    const std::uint32_t asks = pair.areDynamic() ? std::uint32_t{pair.isOpen} & isOneFast : mayStrike;
    return (std::uint32_t{pair.mayMeet} | asks) != 0;  // one branch for all
}

/// Of what does not touch, but may come to that in this step.
TouchFindings lookAtMiss(const WorldState& world, Contact& contact, Real dt) {
    if (!isNearMiss(world, contact, dt)) { return {}; }
    contact.manifold.count = 0;
    return {.passes = true};
}

/// Of bodies that are dynamic both. What passes stays without points, unless it turns out to be hemmed in.
TouchFindings lookAtPassing(WorldState& world, const TouchingPair& pair, Real dt) {
    Contact& contact = world.contacts[pair.contact];
    if (!passEachOther(world, contact, dt)) { return lookAtMiss(world, contact, dt); }
    const bool isOneFast = ((world.traits[pair.bodyA] | world.traits[pair.bodyB]) & kIsFast) != 0;
    if (!pair.isOpen || !isOneFast) { return {}; }
    const bool areAwake = (world.traits[pair.bodyA] & world.traits[pair.bodyB] & kIsAwake) != 0;
    if (areAwake && deepestSeparation(contact.manifold) <= kHemRatio * contact.extent) { return {.mayHem = true}; }
    contact.manifold.count = 0;
    return {.passes = true};
}

/// Of a dynamic body that is awake, and something static or kinematic.
TouchFindings lookAtGround(WorldState& world, const TouchingPair& pair, Real dt) {
    const std::uint32_t slot = pair.dynamicBody();
    if ((world.traits[slot] & kIsAwake) == 0) { return {}; }
    Contact& contact = world.contacts[pair.contact];
    // What is fast or bounces is swept, to the time of its impact; or, not swept, it goes on behind pieces of ground.
    const bool mayStrike = pair.bounces || (world.traits[slot] & kIsFast) != 0;
    if (pair.mayMeet && !mayStrike && lookAtMiss(world, contact, dt).passes) { return {.passes = true}; }
    const std::uint32_t other = slot == pair.bodyA ? pair.bodyB : pair.bodyA;
    TouchFindings found = mayStrike ? footingOf(world, slot, other, contact, dt) : TouchFindings{};
    found.isSunken = pair.isDeep && deepestSeparation(contact.manifold) < -kSlackRatio * contact.extent;
    return found;
}

/// Pairs whose contacts are fetched from memory ahead of time: they lie all over it.
constexpr std::size_t kPairsAhead = 8;
/// Pairs per block of a parallel loop.
constexpr std::size_t kPairGrain = 256;

SWEPT_FORCE_INLINE bool asksForContact(const WorldState& world, const TouchingPair& pair) {
    return asksForContact(pair, world.traits[pair.bodyA], world.traits[pair.bodyB]);
}

/// Of some pairs, one after the other: writes to each and its contact alone.
/// @param then  called with the place of each, once it was looked at; does not change who asks
template <class Then>
SWEPT_FORCE_INLINE void lookAtEach(WorldState& world, std::span<TouchingPair> pairs, Real dt, const Then& then) {
    std::uint32_t asking = 0;  // one bit for each of the next ones: so that none is asked twice
    for (std::size_t i = 0; i < std::min(pairs.size(), kPairsAhead); ++i) {
        asking |= std::uint32_t{asksForContact(world, pairs[i])} << i;
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (i + kPairsAhead < pairs.size()) {
            const TouchingPair& coming = pairs[i + kPairsAhead];
            const bool asks = asksForContact(world, coming);
            const auto contact = coming.contact & maskOf<std::uint32_t>(asks);  // the first one instead of a branch
            prefetch(&world.contacts[contact].manifold);
            asking |= std::uint32_t{asks} << kPairsAhead;
        }
        if ((asking & 1U) != 0) {
            TouchingPair& pair = pairs[i];
            pair.findings = pair.areDynamic() ? lookAtPassing(world, pair, dt) : lookAtGround(world, pair, dt);
        }
        asking >>= 1;
        then(i);
    }
}

/// What a contact with something static or kinematic tells about a dynamic body. @pre awake
void noteGround(WorldState& world, const TouchingPair& pair) {
    if (pair.mayMeet) { world.landings.meeting.push_back(pair); }
    const TouchFindings found = pair.findings;
    if (!(found.bounces || found.rests || found.strikes || pair.isDeep)) { return; }
    Body& body = world.bodies[pair.dynamicBody()];
    body.bounces = body.bounces || found.bounces;
    body.rests = body.rests || found.rests;
    body.strikes = body.strikes || found.strikes;
    body.deepContact = body.deepContact || pair.isDeep;
    body.sunk = body.sunk || found.isSunken;
}

}  // namespace

void noteTouching(WorldState& world, Real dt) {
    // Where they are does not change, but who writes bytes might have written that, too, as far as compilers know.
    const std::span<BodyTraits> traits = world.traits;
    const std::span<TouchingPair> pairs = world.touching;
    const bool isShared = world.loops->workerCount() > 1;
    if (isShared) {
        world.loops->run(pairs.size(), kPairGrain, [&world, pairs, dt](std::size_t begin, std::size_t end, int) {
            lookAtEach(world, pairs.subspan(begin, end - begin), dt, [](std::size_t) {});
        });
    }
    world.hemmed.passing.clear();
    world.landings.meeting.clear();
    auto keep = pairs.begin();
    const auto note = [&](std::size_t i) {
        const TouchingPair& pair = pairs[i];
        BodyTraits& a = traits[pair.bodyA];
        BodyTraits& b = traits[pair.bodyB];
        const bool awakeA = (a & kIsAwake) != 0;
        const bool awakeB = (b & kIsAwake) != 0;
        if (!awakeA && !awakeB) { return; }
        if (pair.findings.mayHem) { world.hemmed.passing.push_back(pair); }
        if (pair.findings.passes) { --world.counters.touching; }
        if (pair.findings.mayHem || pair.findings.passes) { return; }
        if (!pair.areDynamic()) {
            if ((traits[pair.dynamicBody()] & kIsAwake) != 0) { noteGround(world, pair); }
        } else if (awakeA && awakeB) {
            world.islands.unite(pair.bodyA, pair.bodyB);
        }
        if (awakeA) { a |= pair.dynamicB ? kHasContact | kTouchesDynamic : kHasContact; }
        if (awakeB) { b |= pair.dynamicA ? kHasContact | kTouchesDynamic : kHasContact; }
        *keep++ = pair;
    };
    if (isShared) {
        for (std::size_t i = 0; i < pairs.size(); ++i) { note(i); }
    } else {
        lookAtEach(world, pairs, dt, note);
    }
    world.touching.erase(world.touching.begin() + (keep - pairs.begin()), world.touching.end());
    holdHemmedPairs(world);
}

}  // namespace swept::inline SWEPT_PRECISION
