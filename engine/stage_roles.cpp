#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>

#include "../shapes/branchless.h"
#include "modes.h"
#include "step.h"
#include "tolerances.h"
#include "waking.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kRoleGrain = 128;

/// Bodies that are fetched ahead: most of them are written, and others read them since.
constexpr std::size_t kResetAhead = 16;

/// @param coming  of the same worker
[[gnu::always_inline]] inline void fetchForReset(const WorldState& world, std::span<const std::uint32_t> coming) {
    if (coming.size() <= kResetAhead) { return; }
    const std::uint32_t slot = coming[kResetAhead];
    const Body& body = world.bodies[slot];
    fetchToWrite(body.awake);
    fetchToWrite(body.startAngle);
    __builtin_prefetch(&world.motions[slot]);
    __builtin_prefetch(&world.glances[slot]);
}

/// @param restSpeed  `restSpeedOf` the step
void resetBody(WorldState& world, std::uint32_t slot, Real restSpeed, Real dt) {
    Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    body.fresh = body.deepContact = body.sunk = false;
    body.bounces = body.rests = body.strikes = body.startled = body.flung = false;
    // What just woke has no bound yet.
    const Real known = world.glances[slot].motion;
    const Real bound = known < 0 ? motionBound(world, slot, dt) : known;
    body.fast = body.extent > 0 && bound > kFastRatio * body.extent;
    const bool isAtRest = isStill(body, motion, restSpeed, dt);
    if (!isAtRest) { body.soughtSteps = 0; }
    world.traits[slot] = static_cast<BodyTraits>(kIsAwake | (body.isDynamic() ? kIsDynamic : 0) |
                                                 (body.fast ? kIsFast : 0) | (isAtRest ? kIsStill : 0));
    body.startCenter = motion.center;
    body.startAngle = motion.angle;
}

void startle(WorldState& world, const Contact& contact, Real dt) {
    if (contact.sensor || contact.dynamicA == contact.dynamicB) { return; }
    const std::uint32_t kinematic = contact.dynamicB ? contact.bodyA : contact.bodyB;
    const std::uint32_t other = contact.dynamicB ? contact.bodyB : contact.bodyA;
    const Body& mover = world.bodies[kinematic];
    if (mover.def.type != BodyType::kinematic || !mover.awake) { return; }
    Body& body = world.bodies[other];
    if (!(body.extent > 0)) { return; }
    if (!(motionBound(world, kinematic, dt) > kFastRatio * contact.extent)) { return; }
    const std::size_t before = world.awake.size();
    wake(world, other);
    resetBodies(world, std::span(world.awake).subspan(before), dt);
    body.fast = body.startled = true;
    // Nor is it held (held_islands.h): what passes over it in this step may not touch it yet.
    world.traits[other] = static_cast<BodyTraits>((world.traits[other] | kIsFast) & ~kIsStill);
}

/// A moving kinematic body passes over what rests as fast as that could pass under it: everything in the box of its
/// coming step is awake and fast.
void startleNearKinematicBodies(WorldState& world, Real dt) {
    const auto mayStartle = [&world](std::uint32_t slot) { return isAwakeKinematic(world.traits[slot]); };
    for (std::size_t i = 0; i < world.probes.size(); ++i) {
        const ContactProbe& probe = world.probes[i];
        if (probe.isPlain || !(mayStartle(probe.bodyA) || mayStartle(probe.bodyB))) { continue; }
        startle(world, world.contacts[probe.contact], dt);
    }
}

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

/// What the contacts tell about their bodies, and which bodies they tie together. Forgets what sleeps or passes by.
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

bool isFlyer(const WorldState& world, const Body& body) {
    const bool isFlung = body.fast && (body.strikes || !body.rests);
    const bool isAlone = body.holdingJoints == 0 && !body.touchesDynamic && !body.deepContact;
    if (!isAlone || !(isFlung || body.bounces)) { return false; }
    const ContinuousMode mode = modeOf(world, body);
    return isFlung ? isSwept(mode) : mode == ContinuousMode::subStep;
}

/// @param traits  of the body, which is awake
BodyRole roleOf(const WorldState& world, const Body& body, BodyTraits traits) {
    if ((traits & kIsDynamic) == 0) { return BodyRole::free; }
    if (isFlyer(world, body)) { return BodyRole::flyer; }
    return body.holdingJoints == 0 && !body.hasContact ? BodyRole::free : BodyRole::solved;
}

/// What it can tell from the traits, which are small, is left to who lists the bodies in order. Of most bodies it looks
/// at their first lines of memory alone.
void giveRoles(WorldState& world) {
    std::atomic<std::uint32_t> bullets = 0;
    std::atomic<bool> isAnyFast = false;
    world.loops->run(world.awake.size(), kRoleGrain, [&](std::size_t begin, std::size_t end, int) {
        std::uint32_t some = 0;
        bool isOneFast = false;
        for (std::size_t i = begin; i < end; ++i) {
            BodyTraits& traits = world.traits[world.awake[i]];
            Body& body = world.bodies[world.awake[i]];
            body.hasContact = (traits & kHasContact) != 0;
            body.touchesDynamic = (traits & kTouchesDynamic) != 0;
            body.role = roleOf(world, body, traits);
            if (body.role != BodyRole::solved) { body.effort = {}; }
            if (body.role == BodyRole::flyer) { traits |= kIsFlyer; }
            if (body.role == BodyRole::solved) { traits |= kIsTied; }
            const bool isBullet = world.bulletBodies > 0 && body.def.bullet;
            some += isBullet ? 1 : 0;
            isOneFast = isOneFast || body.fast || body.sunk || isBullet || body.role == BodyRole::flyer;
        }
        if (some > 0) { bullets.fetch_add(some, std::memory_order_relaxed); }
        if (isOneFast) { isAnyFast.store(true, std::memory_order_relaxed); }
    });
    world.bullets = bullets;
    world.anyFast = isAnyFast;
}

/// In order of waking. Which role is next, nothing foretells: each is written down, and kept if it was meant.
void listRoles(WorldState& world) {
    const std::size_t count = world.awake.size();
    world.flyers.resize(count);
    world.tied.resize(count);
    std::size_t flyers = 0;
    std::size_t tied = 0;
    for (const std::uint32_t slot : world.awake) {
        const BodyTraits traits = world.traits[slot];
        world.flyers[flyers] = slot;
        world.tied[tied] = slot;
        flyers += (traits & kIsFlyer) != 0 ? 1 : 0;
        tied += (traits & kIsTied) != 0 ? 1 : 0;
    }
    world.flyers.resize(flyers);
    world.tied.resize(tied);
    world.counters.freeBodies += count - flyers - tied;
}

}  // namespace

void resetBodies(WorldState& world, std::span<const std::uint32_t> awake, Real dt) {
    const Real restSpeed = restSpeedOf(world, dt);
    for (std::size_t i = 0; i < awake.size(); ++i) {
        fetchForReset(world, awake.subspan(i));
        resetBody(world, awake[i], restSpeed, dt);
    }
}

void assignRoles(WorldState& world, Real dt) {
    if (world.kinematicBodies > 0) {
        const std::size_t before = world.awake.size();
        startleNearKinematicBodies(world, dt);
        if (!world.parked.woken.empty()) { listUnparked(world); }
        const std::size_t startled = world.awake.size();
        wakeOnward(world, before);
        if (!world.parked.woken.empty()) { listUnparked(world); }
        resetBodies(world, std::span(world.awake).subspan(startled), dt);
    }
    world.islands.reset(world.bodies.slotCount(), world.awake);
    noteTouching(world, dt);
    giveRoles(world);
    listRoles(world);
    world.counters.solvedBodies = world.tied.size();
    world.counters.settledBodies = world.held.bodies;
    world.counters.islands = world.held.inUse.size();
    world.counters.flyers = world.flyers.size();
    world.counters.awakeBodies = world.awake.size() + world.held.bodies;
}

/// By contacts the bodies are united already.
void findIslands(WorldState& world) {
    if (!world.jointChains.areCurrent) { findJointChains(world); }
    for (const JointChains::Member& member : world.jointChains.members) {
        world.islands.unite(member.body, member.lowest);
    }
    std::uint64_t count = 0;
    for (const std::uint32_t slot : world.tied) { count += world.islands.find(slot) == slot ? 1 : 0; }
    world.counters.islands += count;
}

}  // namespace swept::inline SWEPT_PRECISION
