#include "note_touching.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "../shapes/branchless.h"
#include "hemmed_pairs.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contact of a body with something static or kinematic, as far as it decides how the body is moved.
struct Footing {
    bool bounces = false;  ///< it will, or did and is on its way
    bool rests = false;    ///< it is carried, at least at one point
    bool strikes = false;  ///< a point gets there within this step, and not slowly
};

/// A bouncing body flies from impact to impact on a parabola, however slow it is: what comes down from the separation
/// that there is now is faster than what does not bounce. A body that is carried is moved by the solver, however fast
/// it slides, until it strikes something: the solver shares such a blow among the contacts less well, and may throw the
/// body up.
Footing footingOf(const WorldState& world, std::uint32_t slot, std::uint32_t otherSlot, const Contact& contact,
                  Real dt) {
    Footing footing;
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const BodyMotion& other = world.motions[otherSlot];
    const Vec2 fromA = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const Vec2 normal = contact.bodyB == slot ? fromA : -fromA;
    const Real pull = -dot(accelerationOf(world, body), normal);
    // What is pulled so hard that the pull alone makes it fast would sink into a soft contact.
    const bool carries = pull > 0 && pull * square(dt) <= kFastRatio * body.extent;
    const Real threshold = bounceThreshold(world, body, dt);
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const DVec2 point = apply(world.motions[contact.bodyA].pose, contact.manifold.points[i].point);
        const Vec2 velocity = motion.velocity + cross(motion.angularVelocity, toReal(point - motion.center)) -
                              other.velocity - cross(other.angularVelocity, toReal(point - other.center));
        const Real approach = -dot(velocity, normal);
        const Real gap = std::max(contact.manifold.points[i].separation, Real(0));
        const bool returns = pull > 0 || approach * dt > gap;
        const bool isSlow = square(approach) + 2 * std::max(pull, Real(0)) * gap <= square(threshold);
        footing.bounces = footing.bounces || (contact.restitution > 0 && returns && !isSlow);
        footing.strikes = footing.strikes || (approach * dt > gap && !isSlow);
        footing.rests = footing.rests || (carries && isSlow && gap <= kEndRatio * contact.extent);
    }
    return footing;
}

/// Fastest that the bodies of a contact close in on each other within the step, m/s.
Real closingSpeed(const WorldState& world, const Contact& contact, Vec2 normal, Real dt) {
    const BodyGlance& glanceA = world.glances[contact.bodyA];
    const BodyGlance& glanceB = world.glances[contact.bodyB];
    if (glanceA.isAwake() && glanceB.isAwake()) {
        const Real turning = glanceA.swing + glanceB.swing;
        return turning - dot(glanceB.velocity - glanceA.velocity, normal) + dt * length(glanceB.pull - glanceA.pull);
    }
    // Likewise, of what woke since, or sleeps.
    const Body& a = world.bodies[contact.bodyA];
    const Body& b = world.bodies[contact.bodyB];
    const BodyMotion& motionA = world.motions[contact.bodyA];
    const BodyMotion& motionB = world.motions[contact.bodyB];
    const Vec2 pull = accelerationOf(world, b) - accelerationOf(world, a);
    const Real turning = std::fabs(motionA.angularVelocity) * a.radius + std::fabs(motionB.angularVelocity) * b.radius;
    return turning - dot(motionB.velocity - motionA.velocity, normal) + dt * length(pull);
}

/// Dynamic bodies that are near each other, one of them fast, but will not meet in this step do not hold each other.
/// @pre `TouchingPair::isOpen`
bool passEachOther(const WorldState& world, const Contact& contact, Real dt) {
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    return closingSpeed(world, contact, normal, dt) * dt < deepestSeparation(contact.manifold);
}

/// What passes stays without points, unless it turns out to be hemmed in.
void passBy(WorldState& world, const TouchingPair& pair, bool areAwake) {
    Contact& contact = world.contacts[pair.contact];
    if (areAwake && deepestSeparation(contact.manifold) <= kHemRatio * contact.extent) {
        world.hemmed.passing.push_back(pair);
        return;
    }
    contact.manifold.count = 0;
    --world.counters.touching;
}

/// What a contact with something static or kinematic tells about a dynamic body. Mostly nothing, and then neither is
/// looked at.
void noteGround(WorldState& world, std::uint32_t slot, std::uint32_t otherSlot, const TouchingPair& pair, Real dt) {
    const bool mayStrike = pair.bounces || (world.traits[slot] & kIsFast) != 0;
    if (!mayStrike && !pair.isDeep) { return; }
    Body& body = world.bodies[slot];
    if (mayStrike) {
        const Footing footing = footingOf(world, slot, otherSlot, world.contacts[pair.contact], dt);
        body.bounces = body.bounces || footing.bounces;
        body.rests = body.rests || footing.rests;
        body.strikes = body.strikes || footing.strikes;
    }
    if (!pair.isDeep) { return; }
    const Contact& contact = world.contacts[pair.contact];
    body.deepContact = true;
    body.sunk = body.sunk || deepestSeparation(contact.manifold) < -kSlackRatio * contact.extent;
}

/// Pairs whose contacts are fetched from memory ahead of time: they lie all over it.
constexpr std::size_t kPairsAhead = 8;

/// Those that may pass each other are looked at (`passEachOther`).
[[gnu::always_inline]] inline void fetchAhead(const WorldState& world, std::span<const TouchingPair> pairs,
                                              std::size_t place) {
    if (place + kPairsAhead >= pairs.size()) { return; }
    const TouchingPair& coming = pairs[place + kPairsAhead];
    const auto contact = coming.contact & maskOf<std::uint32_t>(coming.isOpen);  // the first one instead of a branch
    __builtin_prefetch(&world.contacts[contact].manifold);
}

}  // namespace

void noteTouching(WorldState& world, Real dt) {
    // Where they are does not change, but who writes bytes might have written that, too, as far as compilers know.
    const std::span<BodyTraits> traits = world.traits;
    const std::span<TouchingPair> pairs = world.touching;
    world.hemmed.passing.clear();
    auto keep = pairs.begin();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        fetchAhead(world, pairs, i);
        const TouchingPair pair = pairs[i];
        BodyTraits& a = traits[pair.bodyA];
        BodyTraits& b = traits[pair.bodyB];
        const bool awakeA = (a & kIsAwake) != 0;
        const bool awakeB = (b & kIsAwake) != 0;
        if (!awakeA && !awakeB) { continue; }
        const bool mayPass = (std::uint32_t{pair.isOpen} & ((a | b) / kIsFast)) != 0;  // one branch for both
        if (!pair.areDynamic()) {
            if (pair.dynamicA && awakeA) { noteGround(world, pair.bodyA, pair.bodyB, pair, dt); }
            if (pair.dynamicB && awakeB) { noteGround(world, pair.bodyB, pair.bodyA, pair, dt); }
        } else if (mayPass && passEachOther(world, world.contacts[pair.contact], dt)) {
            passBy(world, pair, awakeA && awakeB);
            continue;
        } else if (awakeA && awakeB) {
            world.islands.unite(pair.bodyA, pair.bodyB);
        }
        if (awakeA) { a |= pair.dynamicB ? kHasContact | kTouchesDynamic : kHasContact; }
        if (awakeB) { b |= pair.dynamicA ? kHasContact | kTouchesDynamic : kHasContact; }
        *keep++ = pair;
    }
    world.touching.erase(world.touching.begin() + (keep - pairs.begin()), world.touching.end());
    holdHemmedPairs(world);
}

}  // namespace swept::inline SWEPT_PRECISION
